// The largest parallax in the prop, compared with the angles between the two eyes' own lines to both points, over random rays.
#include "app/settings/stereo_parallax.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace frustumscreen::settings {
namespace {

/// The angle by which two eyes on either side of `eye`, across the line of sight, converge on a point.
double convergence(const glm::dvec3& eye, const glm::dvec3& point, double interocular_m) {
    const glm::dvec3 ahead = glm::normalize(point - eye);
    const glm::dvec3 helper = std::abs(ahead.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 half = 0.5 * interocular_m * glm::normalize(glm::cross(ahead, helper));
    return std::acos(std::clamp(
        glm::dot(glm::normalize(point - eye - half), glm::normalize(point - eye + half)), -1.0, 1.0));
}

/// The largest over random eyes and rays. Points along a ray are inside the prop if they are behind every plane; they are found by
/// halving, from the ray's point that is deepest in the prop.
double by_random_rays(const Settings& settings, double distance_m, double lowest_rad) {
    const geometry::PropShape prop = make_prop(settings.prop);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const auto depth = [&](const glm::dvec3& p) {
        double least = 1e9;
        for (const geometry::Plane& bound : prop.bounds) {
            least = std::min(least, -bound.distance(p));
        }
        return least;
    };
    double largest = 0.0;
    for (int k = 0; k < 40'000; ++k) {
        const double elevation = lowest_rad + share(random) * (0.5 * std::numbers::pi - lowest_rad);
        const double azimuth = 2.0 * std::numbers::pi * share(random);
        const glm::dvec3 eye =
            distance_m * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                                    std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        const glm::dvec3 inside =
            prop.middle + glm::dvec3(0.16, 0.16, 0.08) *
                              (2.0 * glm::dvec3(share(random), share(random), share(random)) - 1.0);
        if (depth(inside) <= 0.0 || depth(eye) > 0.0) {
            continue;
        }
        const auto surface = [&](glm::dvec3 out) {
            glm::dvec3 in = inside;
            for (int halving = 0; halving < 40; ++halving) {
                const glm::dvec3 middle = 0.5 * (in + out);
                (depth(middle) > 0.0 ? in : out) = middle;
            }
            return in;
        };
        const glm::dvec3 near = surface(eye);
        const glm::dvec3 far = surface(eye + 4.0 * (inside - eye));
        if (near.z < 1e-6 && settings.prop.zone == PropZone::Table) {
            continue; // through the foot, which no eye on the table's side sees
        }
        const double b = 1e-3 * settings.eye.interocular_mm;
        largest = std::max(largest, convergence(eye, near, b) - convergence(eye, far, b));
    }
    return largest;
}

TEST(StereoParallax, MatchesTracedEyeRays) {
    Settings table;
    Settings steep;
    steep.prop.base_m = 0.16;
    steep.prop.top_m = 0.09;
    steep.prop.height_m = 0.12;
    steep.eye.lowest_elevation_deg = 40.0;
    Settings hand;
    hand.prop = cube_settings(0.10);
    hand.prop.zone = PropZone::Hand;
    for (const Settings* each : {&table, &steep, &hand}) {
        const double lowest = each == &hand ? -0.5 * std::numbers::pi
                                            : each->eye.lowest_elevation_deg * std::numbers::pi / 180.0;
        for (const double distance_m : {0.35, 0.7, 1.5}) {
            const double traced = by_random_rays(*each, distance_m, lowest);
            const double largest = largest_parallax_rad(*each, distance_m);
            EXPECT_GT(largest, 0.97 * traced) << distance_m;
            EXPECT_LT(largest, 1.10 * traced) << distance_m; // random rays miss the corners
        }
    }
}

TEST(StereoParallax, IsComfortableFromADistanceOn) {
    Settings settings;
    const std::optional<double> from_m = comfortable_distance_m(settings);
    ASSERT_TRUE(from_m);
    EXPECT_GT(*from_m, settings.eye.nearest_m);
    EXPECT_LE(largest_parallax_rad(settings, *from_m), comfortable_parallax_rad);
    EXPECT_GT(largest_parallax_rad(settings, *from_m - 0.01), comfortable_parallax_rad);
    EXPECT_NEAR(comfortable_parallax_rad, std::numbers::pi / 180.0, 1e-18);
    settings.eye.farthest_m = 0.5;
    EXPECT_FALSE(comfortable_distance_m(settings));
    settings.eye.interocular_mm = 0.0;
    EXPECT_EQ(largest_parallax_rad(settings, 0.35), 0.0);
}

} // namespace
} // namespace frustumscreen::settings
