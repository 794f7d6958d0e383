// The beam: how intensity falls with the distance, where the eye no longer sees it, and which places lie in the content.

#include "app/geometry/pinhole.h"
#include "app/torch/torch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace frustumscreen::torch {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::array all{Attenuation::InverseSquare, Attenuation::Linear, Attenuation::SmoothStep,
                         Attenuation::None};

Beam beam_of(Attenuation attenuation, Shape shape = Shape::Round) {
    Beam beam;
    beam.shape = shape;
    beam.attenuation = attenuation;
    beam.full_m = 0.5;
    beam.dark_m = 1.5;
    return beam;
}

TEST(Beam, AttenuatesByEachFunction) {
    const Beam square = beam_of(Attenuation::InverseSquare);
    EXPECT_EQ(attenuation_at(square, 1.0), 0.25);
    EXPECT_EQ(attenuation_at(square, 4.0), 1.0 / 64.0);
    const Beam linear = beam_of(Attenuation::Linear);
    EXPECT_EQ(attenuation_at(linear, 0.75), 0.75);
    EXPECT_EQ(attenuation_at(linear, 1.0), 0.5);
    EXPECT_EQ(attenuation_at(linear, 1.5), 0.0);
    const Beam smooth = beam_of(Attenuation::SmoothStep);
    EXPECT_EQ(attenuation_at(smooth, 0.75), 1.0 - 10.0 / 64.0);
    EXPECT_EQ(attenuation_at(smooth, 1.0), 0.5);
    EXPECT_EQ(attenuation_at(smooth, 1.5), 0.0);
    const Beam none = beam_of(Attenuation::None);
    EXPECT_EQ(attenuation_at(none, 1e6), 1.0);
}

TEST(Beam, IsFullUpToItsFullDistanceAndThenNeverBrightens) {
    for (const Attenuation attenuation : all) {
        const Beam beam = beam_of(attenuation);
        for (const double distance_m : {0.0, 1e-300, 0.1, 0.5}) {
            EXPECT_EQ(attenuation_at(beam, distance_m), 1.0);
        }
        double before = 1.0;
        for (double distance_m = 0.5; distance_m < 20.0; distance_m += 0.001) {
            const double now = attenuation_at(beam, distance_m);
            ASSERT_LE(now, before) << distance_m;
            ASSERT_GE(now, 0.0) << distance_m;
            before = now;
        }
    }
}

/// The distance at which the intensity falls to the eye's threshold, by bisection.
double found_reach(const Beam& beam) {
    double bright = beam.full_m;
    double dark = 1e6;
    for (int k = 0; k < 200; ++k) {
        const double middle = 0.5 * (bright + dark);
        (attenuation_at(beam, middle) > min_intensity ? bright : dark) = middle;
    }
    return bright;
}

TEST(Beam, ReachIsWhereTheIntensityFallsToItsMinimum) {
    for (const auto& [full_m, dark_m] : {std::pair(0.5, 1.5), {0.3, 0.31}, {0.001, 40.0}, {2.0, 1000.0}}) {
        for (const Attenuation attenuation :
             {Attenuation::InverseSquare, Attenuation::Linear, Attenuation::SmoothStep}) {
            Beam beam = beam_of(attenuation);
            beam.full_m = full_m;
            beam.dark_m = dark_m;
            const double reach = reach_m(beam);
            // The smooth step is flat where it ends: a rounding of the intensity moves its root by some hundred roundings.
            EXPECT_NEAR(reach, found_reach(beam), 1e-12 * dark_m)
                << attenuation_names[static_cast<std::size_t>(attenuation)] << ' ' << full_m << ' ' << dark_m;
            EXPECT_NEAR(attenuation_at(beam, reach), min_intensity, 1e-12);
        }
    }
    EXPECT_EQ(reach_m(beam_of(Attenuation::None)), never);
}

TEST(Beam, ReachBoundsTheLight) {
    for (const Attenuation attenuation : all) {
        const Beam beam = beam_of(attenuation);
        const double reach = reach_m(beam);
        if (attenuation != Attenuation::None) {
            EXPECT_TRUE(place_in_content(beam, {0.0, 0.0, std::nextafter(reach, 0.0)}));
            EXPECT_FALSE(place_in_content(beam, {0.0, 0.0, std::nextafter(reach, never)}));
            EXPECT_EQ(intensity_at(beam, {0.0, 0.0, 1.001 * reach}), 0.0);
        } else {
            EXPECT_EQ(intensity_at(beam, {0.0, 0.0, 1e9}), 1.0);
        }
    }
}

/// A pinhole whose picture is the content, one pixel wide.
geometry::Pinhole pinhole_of(const Beam& beam) {
    const double focal = 0.5 / std::tan(0.5 * beam.opening_rad);
    return {.width = 1, .height = 1, .fx = focal, .fy = focal / beam.height_per_width, .cx = 0.5, .cy = 0.5};
}

TEST(Beam, ProjectsItsContentLikeAPinhole) {
    std::mt19937 random(48);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    std::size_t inside = 0;
    std::size_t outside = 0;
    for (const Shape shape : {Shape::Round, Shape::Rectangle}) {
        for (const double opening_deg : {0.01, 8.0, 30.0, 60.0, 120.0, 179.0}) {
            Beam beam = beam_of(Attenuation::None, shape);
            beam.opening_rad = opening_deg * std::numbers::pi / 180.0;
            beam.height_per_width = 0.75;
            const double spread = 1.5 * std::tan(0.5 * beam.opening_rad);
            for (int k = 0; k < 1000; ++k) {
                const double z = std::exp(4.0 * u(random));
                const glm::dvec3 point(spread * z * u(random), spread * z * u(random), z);
                const glm::dvec2 pixel = pinhole_of(beam).pixel(point).value();
                const double edge = shape == Shape::Round
                                        ? 0.5 - glm::length(pixel - 0.5)
                                        : 0.5 - std::fmax(std::fabs(pixel.x - 0.5), std::fabs(pixel.y - 0.5));
                const std::optional<glm::dvec2> place = place_in_content(beam, point);
                if (std::fabs(edge) < 1e-12) {
                    continue;
                }
                ASSERT_EQ(place.has_value(), edge > 0.0) << opening_deg << ' ' << edge;
                if (place) {
                    ++inside;
                    ASSERT_LT(glm::distance(*place, pixel), 1e-12);
                } else {
                    ++outside;
                }
            }
        }
    }
    EXPECT_GT(inside, 2000U);
    EXPECT_GT(outside, 2000U);
}

TEST(Beam, LightsNothingAtOrBehindItsOriginOrAtNonFinitePoints) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Attenuation attenuation : all) {
        for (const Shape shape : {Shape::Round, Shape::Rectangle}) {
            const Beam beam = beam_of(attenuation, shape);
            for (const glm::dvec3& point :
                 {glm::dvec3(0.0), glm::dvec3(0.1, 0.0, 0.0), glm::dvec3(0.0, 0.0, -1e-300),
                  glm::dvec3(0.0, 0.0, -0.5), glm::dvec3(nan, 0.0, 0.5), glm::dvec3(0.0, nan, 0.5),
                  glm::dvec3(0.0, 0.0, nan), glm::dvec3(0.0, never, 0.5), glm::dvec3(0.0, never, never),
                  glm::dvec3(never, 0.0, never), glm::dvec3(0.0, 0.0, -never)}) {
                EXPECT_FALSE(place_in_content(beam, point)) << point.x << ' ' << point.y << ' ' << point.z;
                EXPECT_EQ(intensity_at(beam, point), 0.0);
            }
            EXPECT_TRUE(place_in_content(beam, {0.0, 0.0, 1e-300})); // right before it
        }
    }
}

TEST(Beam, EdgeMatchesTheOpening) {
    Beam beam = beam_of(Attenuation::None, Shape::Rectangle);
    beam.opening_rad = std::numbers::pi / 2.0;
    beam.height_per_width = 0.5;
    EXPECT_NEAR(half_extent(beam).x, 1.0, 1e-15);
    EXPECT_NEAR(half_extent(beam).y, 0.5, 1e-15);
    EXPECT_TRUE(place_in_content(beam, {0.999, 0.499, 1.0}));
    EXPECT_FALSE(place_in_content(beam, {1.001, 0.0, 1.0}));
    EXPECT_FALSE(place_in_content(beam, {0.0, 0.501, 1.0}));
    beam.shape = Shape::Round;
    EXPECT_TRUE(place_in_content(beam, {0.0, 0.499, 1.0}));
    EXPECT_FALSE(place_in_content(beam, {0.999, 0.499, 1.0})); // the rectangle's corner
    EXPECT_LT(glm::distance(*place_in_content(beam, {-0.5, 0.25, 1.0}), glm::dvec2(0.25, 0.75)), 1e-15);
}

} // namespace
} // namespace frustumscreen::torch
