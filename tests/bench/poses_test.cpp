#include "app/bench/truth/poses.h"
#include "tests/settings/steep_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustumscreen::bench {
namespace {

/// A projector 0.95 m above the table, looking straight down; its picture's top is away from the visitor.
settings::Settings overhead() {
    settings::Settings settings = settings::steep_table();
    settings.projector.table_from_projector = {glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 0.95}};
    return settings;
}

TEST(Poses, DependOnlyOnTheSeed) {
    const settings::Settings settings = overhead();
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const auto a = draw_poses(settings, prop, 20, 7);
    const auto b = draw_poses(settings, prop, 20, 7);
    const auto c = draw_poses(settings, prop, 20, 8);
    ASSERT_TRUE(a && b && c);
    ASSERT_EQ(a->size(), 20U);
    for (std::size_t k = 0; k < 20; ++k) {
        EXPECT_EQ((*a)[k].eye_m, (*b)[k].eye_m);
        EXPECT_EQ((*a)[k].table_from_prop.translation, (*b)[k].table_from_prop.translation);
        EXPECT_NE((*a)[k].eye_m, (*c)[k].eye_m);
    }
}

TEST(Poses, ALargerCountBeginsWithTheSmaller) {
    const settings::Settings settings = overhead();
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const auto few = draw_poses(settings, prop, 5, 3);
    const auto many = draw_poses(settings, prop, 15, 3);
    ASSERT_TRUE(few && many);
    for (std::size_t k = 0; k < few->size(); ++k) {
        EXPECT_EQ((*few)[k].eye_m, (*many)[k].eye_m);
    }
}

TEST(Poses, StayInsideTheZone) {
    const settings::Settings settings = overhead();
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const auto poses = draw_poses(settings, prop, 200, 1);
    ASSERT_TRUE(poses);
    bool left = false;
    bool far = false;
    for (const BenchPose& pose : *poses) {
        const glm::dvec3 foot = pose.table_from_prop.translation;
        const glm::dvec3 to_eye = pose.eye_m - foot;
        EXPECT_EQ(foot.z, 0.0);
        EXPECT_LE(std::abs(foot.x), settings.table.width_m / 2.0);
        EXPECT_LE(std::abs(foot.y), settings.table.depth_m / 2.0);
        EXPECT_GE(glm::length(to_eye), settings.eye.nearest_m - 1e-9);
        EXPECT_LE(glm::length(to_eye), settings.eye.farthest_m + 1e-9);
        const double elevation_deg = std::asin(to_eye.z / glm::length(to_eye)) * 180.0 / std::numbers::pi;
        EXPECT_GE(elevation_deg, settings.eye.lowest_elevation_deg - 1e-9);
        // Corners in the picture, by plain arithmetic for a projector that looks straight down.
        for (const double corner : {-1.0, 1.0}) {
            const glm::dvec3 local(corner * settings.prop.base_m / 2.0, settings.prop.base_m / 2.0, 0.0);
            const glm::dvec3 world = pose.table_from_prop.point(local);
            EXPECT_LE(std::abs(world.x) * 1872.0 / 0.95, 640.0);
            EXPECT_LE(std::abs(world.y) * 1872.0 / 0.95, 400.0);
        }
        left = left || foot.x < -0.05;
        far = far || glm::length(to_eye) > 1.5;
    }
    EXPECT_TRUE(left && far);
}

TEST(Poses, ZoneRequiresEveryFaceSeenByTheEyeToBeLit) {
    const settings::Settings settings = overhead();
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    BenchPose pose{{glm::dquat(1.0, 0.0, 0.0, 0.0), {0.0, 0.0, 0.0}}, {0.6, 0.0, 0.3}};
    EXPECT_TRUE(in_zone(settings, prop, pose));
    // The face +X leans inwards by 35 mm over 120 mm: its plane reaches height 0.95 m at x = 0.08 - 0.277 m
    // from the prop's axis, so a prop shifted by 0.2 m to the right turns that face away from the light.
    pose.table_from_prop.translation.x = 0.2;
    EXPECT_FALSE(in_zone(settings, prop, pose));
    pose.eye_m = {-0.6, 0.0, 0.3}; // but it is not visible from the left
    EXPECT_TRUE(in_zone(settings, prop, pose));
}

TEST(Poses, AProjectorThatLightsNothingIsRefusedInOneLine) {
    settings::Settings settings = overhead();
    settings.projector.pinhole = {64, 40, 1872.0, 1872.0, 32.0, 20.0};
    const auto poses = draw_poses(settings, settings::make_prop(settings.prop), 1, 1);
    ASSERT_FALSE(poses);
    EXPECT_EQ(poses.error().kind, ErrorKind::BadConfiguration);
    EXPECT_EQ(poses.error().message.find('\n'), std::string::npos);
}

} // namespace
} // namespace frustumscreen::bench
