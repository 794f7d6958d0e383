#include "app/settings/looking_at.h"
#include "app/tags/tag_pose.h"
#include "app/tracking/pose_math.h"
#include "firmware_host/tags/tag_detector.h"
#include "tests/simulators/tags/skirt.h"
#include "tests/simulators/tags/tag_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::tags {
namespace {

simulators::SceneCamera above() {
    simulators::SceneCamera camera;
    camera.table_from_camera = *settings::looking_at({0.0, -0.3, 1.3}, {0.0, 0.0, 0.0}, 0.0);
    return camera;
}

simulators::PropMotion standing(const geometry::RigidTransform& pose) {
    return [pose](double) { return pose; };
}

TEST(TagDetector, FindsCornersWithoutBias) {
    simulators::SceneCamera camera = above();
    camera.read_noise = camera.shot_noise = 0.0;
    camera.gamma = 1.0;
    const std::vector<PropTag> tags = simulators::tags_of({.tag_m = 0.04});
    const geometry::RigidTransform pose{tracking::rotation_of({0.0, 0.0, 0.3}), {0.05, 0.02, 0.0}};
    const simulators::TagScene scene(geometry::make_frustum({0.1, 0.05, 0.02}), tags, camera, {});
    TagDetector detector;
    std::vector<FoundTag> found;
    detector.find(scene.picture(standing(pose), 1), 1280, 720, found);
    ASSERT_EQ(found.size(), tags.size());
    glm::dvec2 bias(0.0);
    for (const FoundTag& tag : found) {
        const auto known =
            std::find_if(tags.begin(), tags.end(), [&](const PropTag& t) { return t.id == tag.id; });
        ASSERT_NE(known, tags.end());
        const std::array<glm::dvec3, 4> corners = known->corners();
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::dvec2 truth =
                *camera.pinhole.pixel(camera.table_from_camera.inverse().point(pose.point(corners[k])));
            EXPECT_LT(glm::length(tag.corners_px[k] - truth), 0.35) << tag.id << " " << k;
            bias += (tag.corners_px[k] - truth) / (4.0 * static_cast<double>(found.size()));
        }
    }
    EXPECT_LT(glm::length(bias), 0.05) << bias.x << " " << bias.y;
}

TEST(TagDetector, FindsNothingInEmptyOrMisshapenPictures) {
    TagDetector detector;
    std::vector<FoundTag> found(3);
    detector.find({}, 1280, 720, found);
    EXPECT_TRUE(found.empty());
    const std::vector<std::uint8_t> grey(1280 * 720, 90);
    for (const auto& [width, height] :
         {std::pair(1280, 720), {1280, 721}, {0, 0}, {-1, 5}, {15, 15}, {17, 16}}) {
        detector.find(grey, width, height, found);
        EXPECT_TRUE(found.empty());
    }
}

TEST(TagDetector, FindsTagsThatGiveThePose) {
    const simulators::SceneCamera camera = above();
    const std::vector<PropTag> tags = simulators::tags_of({});
    const geometry::RigidTransform pose{tracking::rotation_of({0.0, 0.0, -0.4}), {-0.05, 0.02, 0.0}};
    const simulators::TagScene scene(geometry::make_frustum(geometry::shipped_frustum), tags, camera, {});
    TagDetector detector;
    std::vector<FoundTag> found;
    detector.find(scene.picture(standing(pose), 1), 1280, 720, found);
    const auto seen = pose_from_tags(found, tags, camera.pinhole, 0.2);
    ASSERT_TRUE(seen);
    const tracking::PoseStep step =
        tracking::step_between(pose, camera.table_from_camera * seen->camera_from_prop);
    EXPECT_LT(glm::length(step.shift_m), 0.003);
    EXPECT_LT(glm::length(step.turn_rad), glm::radians(0.6));
    EXPECT_GE(seen->tags, 5U);
}

} // namespace
} // namespace frustumscreen::tags
