// A lamp's one tag at a camera's distance: how often its pose is sure enough, and how far its light is off.
#include "app/settings/looking_at.h"
#include "app/settings/settings.h"
#include "app/tags/tag_pose.h"
#include "app/tracking/pose_math.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>

namespace frustumscreen::tags {
namespace {

struct Seen {
    int looked_at = 0, sure = 0;
    double mean_deg = 0.0, worst_deg = 0.0;
};

/// Lamps in a hand above the table, pointing down at the prop; corners with the detector's noise.
Seen seen(double size_m, double camera_m) {
    const geometry::Pinhole camera{
        .width = 1280, .height = 720, .fx = 1500.0, .fy = 1500.0, .cx = 640.0, .cy = 360.0};
    const geometry::RigidTransform table_from_camera =
        *settings::looking_at({0.1, -0.1, camera_m}, {0.0, 0.0, 0.0}, 0.0);
    settings::TagSettings tag = settings::TorchSettings().tag;
    tag.size_m = size_m;
    const PropTag on_lamp{tag.id, size_m, settings::prop_from_tag(tag)};
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::normal_distribution<double> noise(0.0, usual_corner_sd_px);
    Seen result;
    for (int k = 0; k < 400; ++k) {
        const glm::dvec3 at(0.25 * any(random), -0.1 + 0.1 * any(random), 0.3 + 0.08 * any(random));
        const glm::dvec3 z = glm::normalize(glm::dvec3(0.05 * any(random), 0.1 * any(random), 0.07) - at);
        const glm::dvec3 x = glm::normalize(glm::cross(z, glm::dvec3(0.0, 0.0, 1.0)));
        const geometry::RigidTransform table_from_torch{
            glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z))), at};
        const geometry::RigidTransform camera_from_torch = table_from_camera.inverse() * table_from_torch;
        FoundTag found{.id = tag.id, .corners_px = {}};
        bool visible = true;
        const std::array<glm::dvec3, 4> corners = on_lamp.corners();
        for (std::size_t c = 0; c < corners.size(); ++c) {
            const auto pixel = camera.pixel(camera_from_torch.point(corners.at(c)));
            visible = visible && pixel && pixel->x > 0 && pixel->x < 1280 && pixel->y > 0 && pixel->y < 720;
            found.corners_px.at(c) =
                (pixel ? *pixel : glm::dvec2(0.0)) + glm::dvec2(noise(random), noise(random));
        }
        if (!visible) {
            continue;
        }
        ++result.looked_at;
        const auto pose =
            pose_from_tags(std::span(&found, 1), std::span(&on_lamp, 1), camera, usual_corner_sd_px);
        if (!pose || pose->place_sd_m > 0.02 || pose->turn_sd_rad > 0.12) {
            continue;
        }
        ++result.sure;
        const glm::dvec3 light = (table_from_camera * pose->camera_from_prop).direction({0.0, 0.0, 1.0});
        const double off = glm::degrees(std::acos(std::fmin(1.0, glm::dot(light, z))));
        result.mean_deg += off;
        result.worst_deg = std::fmax(result.worst_deg, off);
    }
    result.mean_deg /= std::max(1, result.sure);
    return result;
}

/// docs/torch.md has these figures: a tag of 40 mm at 1.3 m, of 60 mm at 1.6 m.
TEST(LampTag, GivesASureAndAccuratePoseInMostFrames) {
    for (const auto& [size_m, camera_m] :
         {std::pair(0.04, 1.3), std::pair(0.06, 1.3), std::pair(0.06, 1.6)}) {
        const Seen result = seen(size_m, camera_m);
        EXPECT_GT(result.looked_at, 390);
        EXPECT_GT(result.sure, 0.9 * result.looked_at) << size_m << " " << camera_m;
        EXPECT_LT(result.mean_deg, 0.5);
        EXPECT_LT(result.worst_deg, 3.0);
    }
}

/// One that is too small for the distance gives no pose rather than a wrong one.
TEST(LampTag, RarelyGivesAPoseWhenTooSmall) {
    const Seen result = seen(0.03, 1.6);
    EXPECT_LT(result.sure, 0.1 * result.looked_at);
    EXPECT_LT(result.worst_deg, 3.0);
}

} // namespace
} // namespace frustumscreen::tags
