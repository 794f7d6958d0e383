#include "app/settings/looking_at.h"
#include "app/tags/tag_pose.h"
#include "app/tracking/pose_math.h"
#include "tests/simulators/tags/skirt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace frustumscreen::tags {
namespace {

const geometry::Pinhole camera{1280, 720, 1500.0, 1490.0, 630.0, 365.0, {-0.1, 0.03}};
constexpr double corner_sd_px = 0.2;

geometry::RigidTransform above_the_table() {
    return *settings::looking_at({0.0, -0.5, 1.2}, {0.0, 0.0, 0.0}, 0.0);
}

/// Corners of every tag, projected by the pinhole, with noise.
std::vector<FoundTag> corners_of(const std::vector<PropTag>& tags,
                                 const geometry::RigidTransform& table_from_prop, double sd_px,
                                 std::mt19937_64& random) {
    std::normal_distribution<double> noise(0.0, 1.0);
    const geometry::RigidTransform camera_from_prop = above_the_table().inverse() * table_from_prop;
    std::vector<FoundTag> found;
    for (const PropTag& tag : tags) {
        FoundTag one{tag.id, {}, 50.0};
        const double h = 0.5 * tag.size_m;
        const glm::dvec3 square[4] = {{-h, h, 0}, {h, h, 0}, {h, -h, 0}, {-h, -h, 0}};
        for (std::size_t k = 0; k < 4; ++k) {
            one.corners_px[k] = *camera.pixel(camera_from_prop.point(tag.prop_from_tag.point(square[k]))) +
                                sd_px * glm::dvec2(noise(random), noise(random));
        }
        found.push_back(one);
    }
    return found;
}

geometry::RigidTransform place(double x, double y, double yaw_deg) {
    return {tracking::rotation_of({0.0, 0.0, glm::radians(yaw_deg)}), {x, y, 0.0}};
}

tracking::PoseStep off(const TagPose& pose, const geometry::RigidTransform& truth) {
    return tracking::step_between(truth, above_the_table() * pose.camera_from_prop);
}

TEST(TagPose, ExactCornersGiveTheExactPose) {
    std::mt19937_64 random(1);
    for (const double yaw : {0.0, 37.0, 180.0, -91.0}) {
        const geometry::RigidTransform truth = place(0.1, -0.05, yaw);
        const auto found = corners_of(simulators::tags_of({}), truth, 0.0, random);
        const auto pose = pose_from_tags(found, simulators::tags_of({}), camera, corner_sd_px);
        ASSERT_TRUE(pose);
        EXPECT_LT(glm::length(off(*pose, truth).shift_m), 1e-8);
        EXPECT_LT(glm::length(off(*pose, truth).turn_rad), 1e-7);
        EXPECT_EQ(pose->tags, 8U);
    }
}

/// The reported standard deviation equals the actual one within a fifth, for one tilted tag, for three and
/// for all.
TEST(TagPose, ReportsItsStandardDeviation) {
    std::mt19937_64 random(2);
    const simulators::Skirt skirt{.tag_m = 0.08, .slope_deg = 40.0};
    for (const std::size_t count : {1U, 3U, 8U}) {
        std::vector<PropTag> tags = simulators::tags_of(skirt);
        tags.resize(count);
        double place2 = 0.0, turn2 = 0.0, said_place2 = 0.0, said_turn2 = 0.0;
        constexpr int times = 400;
        for (int k = 0; k < times; ++k) {
            const geometry::RigidTransform truth = place(0.05, 0.0, 0.2 * k);
            const auto found = corners_of(tags, truth, corner_sd_px, random);
            const auto pose = pose_from_tags(found, tags, camera, corner_sd_px);
            ASSERT_TRUE(pose);
            const tracking::PoseStep step = off(*pose, truth);
            place2 += glm::dot(step.shift_m, step.shift_m);
            turn2 += glm::dot(step.turn_rad, step.turn_rad);
            said_place2 += pose->place_sd_m * pose->place_sd_m;
            said_turn2 += pose->turn_sd_rad * pose->turn_sd_rad;
        }
        EXPECT_NEAR(std::sqrt(place2 / said_place2), 1.0, 0.2) << count;
        EXPECT_NEAR(std::sqrt(turn2 / said_turn2), 1.0, 0.2) << count;
    }
}

/// Small, far and seen from almost above: the tilt is ambiguous. The result must never be both sure and
/// wrong.
TEST(TagPose, IsUncertainForASmallSingleTag) {
    std::mt19937_64 random(3);
    const std::vector<PropTag> tags{{7, 0.03, {}}};
    int wrong = 0;
    for (int k = 0; k < 300; ++k) {
        const geometry::RigidTransform truth{tracking::rotation_of({0.35, 0.1, 0.02 * k}), {0.1, 0.1, 0.1}};
        const auto pose =
            pose_from_tags(corners_of(tags, truth, corner_sd_px, random), tags, camera, corner_sd_px);
        ASSERT_TRUE(pose);
        const double turn = glm::length(off(*pose, truth).turn_rad);
        EXPECT_LT(turn, 5.0 * pose->turn_sd_rad) << k;
        wrong += turn > glm::radians(20.0) ? 1 : 0;
    }
    EXPECT_GT(wrong, 5); // the ambiguity occurs
}

TEST(TagPose, LeavesOutMisreadTags) {
    std::mt19937_64 random(4);
    const geometry::RigidTransform truth = place(-0.1, 0.05, 20.0);
    std::vector<PropTag> tags = simulators::tags_of({});
    for (std::size_t k = 0; k < tags.size(); ++k) {
        auto found = corners_of(tags, truth, corner_sd_px, random);
        found[k].id = tags[(k + 3) % tags.size()].id; // the id of another of the prop's tags, which then
                                                      // occurs twice
        std::rotate(found[k].corners_px.begin(), found[k].corners_px.begin() + 1, found[k].corners_px.end());
        auto pose = pose_from_tags(found, tags, camera, corner_sd_px);
        ASSERT_TRUE(pose);
        EXPECT_EQ(pose->tags, 6U);
        found = corners_of(tags, truth, corner_sd_px, random);
        std::swap(found[k].corners_px, found[(k + 1) % tags.size()].corners_px);
        pose = pose_from_tags(found, tags, camera, corner_sd_px);
        ASSERT_TRUE(pose);
        EXPECT_EQ(pose->tags, 6U);
        EXPECT_LT(glm::length(off(*pose, truth).shift_m), 0.002);
    }
}

TEST(TagPose, GivesNoPoseForInvalidCorners) {
    std::mt19937_64 random(5);
    const std::vector<PropTag> tags = simulators::tags_of({});
    EXPECT_FALSE(pose_from_tags({}, tags, camera, corner_sd_px));
    auto found = corners_of(tags, place(0, 0, 0), 0.0, random);
    for (FoundTag& tag : found) {
        tag.id += 100; // belongs to another prop
    }
    EXPECT_FALSE(pose_from_tags(found, tags, camera, corner_sd_px));
    // Two contradicting tags.
    found = corners_of(tags, place(0, 0, 0), 0.0, random);
    found.resize(2);
    std::swap(found[0].id, found[1].id);
    EXPECT_FALSE(pose_from_tags(found, tags, camera, corner_sd_px));
    // Corners at one point, and on a line.
    found.resize(1);
    found[0].corners_px.fill({100.0, 100.0});
    EXPECT_FALSE(pose_from_tags(found, tags, camera, corner_sd_px));
    found[0].corners_px = {glm::dvec2(1, 1), glm::dvec2(50, 50), glm::dvec2(100, 100), glm::dvec2(150, 150)};
    EXPECT_FALSE(pose_from_tags(found, tags, camera, corner_sd_px));
}

constexpr double readout_s = 0.025;
constexpr double frame_s = 1.0 / 30.0;

/// Slid at 0.36 m/s and rotated by 90 degrees per second.
geometry::RigidTransform slid(double t_s) {
    return place(0.02 + 0.3 * t_s, -0.03 + 0.2 * t_s, 20.0 + 90.0 * t_s);
}

/// Each corner at the time when its row is read; the first row at `first_s`.
std::vector<FoundTag> rolled_corners(const std::vector<PropTag>& tags, double first_s) {
    std::mt19937_64 random(1);
    std::vector<FoundTag> found = corners_of(tags, slid(first_s), 0.0, random);
    for (int round = 0; round < 20; ++round) { // until row and time agree
        for (std::size_t k = 0; k < found.size(); ++k) {
            for (std::size_t j = 0; j < 4; ++j) {
                const double row_s = readout_s * found[k].corners_px[j].y / camera.height;
                found[k].corners_px[j] =
                    corners_of({tags[k]}, slid(first_s + row_s), 0.0, random).front().corners_px[j];
            }
        }
    }
    return found;
}

TEST(TagPose, CorrectsARollingShutterByThePreviousPose) {
    const std::vector<PropTag> tags = simulators::tags_of({});
    const std::vector<FoundTag> found = rolled_corners(tags, 0.0);
    const auto skewed = pose_from_tags(found, tags, camera, corner_sd_px, {readout_s, {}, 0.0});
    ASSERT_TRUE(skewed);
    EXPECT_GT(glm::length(off(*skewed, slid(skewed->moment_s)).turn_rad), 0.01);
    const double before_s = 0.4 * readout_s - frame_s;
    const geometry::RigidTransform before = above_the_table().inverse() * slid(before_s);
    const auto pose = pose_from_tags(found, tags, camera, corner_sd_px, {readout_s, before, before_s});
    ASSERT_TRUE(pose);
    EXPECT_LT(glm::length(off(*pose, slid(pose->moment_s)).shift_m), 1e-6);
    EXPECT_LT(glm::length(off(*pose, slid(pose->moment_s)).turn_rad), 1e-6);
}

/// The first pose is skewed, because the motion is unknown; each later pose improves the estimate.
TEST(TagPose, ConvergesUnderARollingShutter) {
    const std::vector<PropTag> tags = simulators::tags_of({});
    RollingShutter shutter{readout_s, {}, 0.0};
    double off_m = 1.0;
    for (int k = 0; k < 12; ++k) {
        const auto found = rolled_corners(tags, k * frame_s);
        const auto pose = pose_from_tags(found, tags, camera, corner_sd_px, shutter);
        ASSERT_TRUE(pose);
        off_m = glm::length(off(*pose, slid(k * frame_s + pose->moment_s)).shift_m);
        shutter.before = pose->camera_from_prop;
        shutter.before_s = pose->moment_s - frame_s;
    }
    EXPECT_LT(off_m, 1e-4);
}

/// With a global shutter the previous pose has no influence.
TEST(TagPose, IgnoresThePreviousPoseWithAGlobalShutter) {
    std::mt19937_64 random(4);
    const std::vector<PropTag> tags = simulators::tags_of({});
    const auto found = corners_of(tags, place(0.05, 0.02, 30.0), corner_sd_px, random);
    const auto alone = pose_from_tags(found, tags, camera, corner_sd_px);
    const auto after = pose_from_tags(found, tags, camera, corner_sd_px, {0.0, slid(0.0), -frame_s});
    ASSERT_TRUE(alone && after);
    EXPECT_EQ(alone->camera_from_prop.translation, after->camera_from_prop.translation);
    EXPECT_EQ(after->moment_s, 0.0);
}

} // namespace
} // namespace frustumscreen::tags
