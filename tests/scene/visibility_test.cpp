// Zones against eyes and props from a seed; poses are inverted by hand with sines and cosines.

#include "app/scene/visibility.h"
#include "tests/settings/steep_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace frustumscreen::scene {
namespace {

struct Draw {
    std::mt19937_64 engine{7};
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine() >> 11U) * 0x1p-53);
    }
    glm::dvec3 direction() {
        const double z = between(-1.0, 1.0);
        const double azimuth = between(0.0, 2.0 * std::numbers::pi);
        const double across = std::sqrt(1.0 - z * z);
        return {across * std::cos(azimuth), across * std::sin(azimuth), z};
    }
};

/// How far a zone extends along n, estimated from random points of it.
template <typename Point> double drawn_reach(const glm::dvec3& n, int draws, Point point) {
    double most = -1e9;
    for (int k = 0; k < draws; ++k) {
        most = std::max(most, glm::dot(n, point()));
    }
    return most;
}

TEST(Visibility, TrackedEyeReachesToTheEdgeOfItsZone) {
    settings::Settings settings = settings::steep_table();
    settings.eye.default_m = {0.0, -0.3, 0.4}; // inside the zone for every pose of the prop
    const Visibility visibility = visibility_of(settings);
    Draw draw;
    const auto eye = [&] {
        const double elevation = std::asin(draw.between(std::sin(15.0 * std::numbers::pi / 180.0), 1.0));
        const double azimuth = draw.between(0.0, 2.0 * std::numbers::pi);
        const double r = draw.between(0.35, 2.0);
        return r * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                              std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    };
    for (int k = 0; k < 40; ++k) {
        const glm::dvec3 n = draw.direction();
        const double reach = visibility.eyes.reach(n);
        const double drawn = drawn_reach(n, 20000, eye);
        EXPECT_GE(reach, drawn) << k;
        EXPECT_LE(reach, drawn + 0.1) << k; // random points come this close to the edge of a ball of 2 m
    }
    EXPECT_TRUE(visibility.views.empty());
}

TEST(Visibility, FixedEyeCoversEveryPlaceAndYawOfTheProp) {
    settings::Settings settings = settings::steep_table();
    settings.eye.tracked = false;
    settings.eye.default_m = {0.1, -0.5, 0.45};
    const Visibility visibility = visibility_of(settings);
    Draw draw;
    const auto seen_from_a_prop = [&](const glm::dvec3& point) {
        const glm::dvec3 d = point - glm::dvec3(draw.between(-0.4, 0.4), draw.between(-0.25, 0.25), 0.0);
        const double yaw = draw.between(0.0, 2.0 * std::numbers::pi);
        return glm::dvec3(std::cos(yaw) * d.x + std::sin(yaw) * d.y,
                          -std::sin(yaw) * d.x + std::cos(yaw) * d.y, d.z);
    };
    for (int k = 0; k < 40; ++k) {
        const glm::dvec3 n = draw.direction();
        const double eye = drawn_reach(n, 20000, [&] { return seen_from_a_prop({0.1, -0.5, 0.45}); });
        const double lens = drawn_reach(n, 20000, [&] { return seen_from_a_prop({0.0, 0.0, 1.2}); });
        EXPECT_GE(visibility.eyes.reach(n), eye);
        EXPECT_LE(visibility.eyes.reach(n), eye + 0.05);
        EXPECT_GE(visibility.lens.reach(n), lens);
        EXPECT_LE(visibility.lens.reach(n), lens + 0.05);
    }
}

TEST(Visibility, FixedViewerAndFixedPropGiveOneView) {
    settings::Settings settings = settings::steep_table();
    settings.eye.tracked = false;
    settings.tracker.kind = settings::TrackerKind::None;
    const Visibility visibility = visibility_of(settings);
    ASSERT_EQ(visibility.views.size(), 1U);
    EXPECT_EQ(visibility.views[0].eye_m, settings.eye.default_m);
    EXPECT_EQ(visibility.eyes.reach({0.0, -1.0, 0.0}), 0.55);
    EXPECT_EQ(visibility.lens.reach({0.0, 0.0, 1.0}), 1.2);
}

TEST(Visibility, RecordingOrDeviceIsUnbounded) {
    for (const settings::TrackerKind kind :
         {settings::TrackerKind::Replay, settings::TrackerKind::Usb, settings::TrackerKind::SpaceMouse}) {
        settings::Settings settings = settings::steep_table();
        settings.tracker.kind = kind;
        const Visibility visibility = visibility_of(settings);
        EXPECT_TRUE(std::isinf(visibility.eyes.reach({0.0, 0.0, -1.0})));
        EXPECT_TRUE(std::isinf(visibility.lens.reach({0.0, 0.0, -1.0})));
    }
}

} // namespace
} // namespace frustumscreen::scene
