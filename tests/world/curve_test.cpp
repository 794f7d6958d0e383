// Curves against the formulas of glTF 2.0, appendix C, worked out by hand. world_values.py compares random ones with SciPy.

#include "app/world/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::world {
namespace {

Curve ramp_curve(Interpolation interpolation) {
    return {.interpolation = interpolation,
            .times_s = {1.0F, 2.0F, 4.0F},
            .values = {{0.0F, 1.0F, 2.0F, 0.0F}, {4.0F, 1.0F, 0.0F, 0.0F}, {8.0F, 3.0F, 0.0F, 0.0F}}};
}

/// About Z.
glm::vec4 turned(double degrees) {
    const double half = degrees / 360.0 * std::numbers::pi;
    return {0.0F, 0.0F, static_cast<float>(std::sin(half)), static_cast<float>(std::cos(half))};
}

double degrees_about_z(const glm::dvec4& rotation) {
    return 2.0 * std::atan2(rotation.z, rotation.w) * 180.0 / std::numbers::pi;
}

TEST(Curve, StepKeepsAValueUntilTheNextKey) {
    const Curve curve = ramp_curve(Interpolation::Step);
    EXPECT_EQ(value_at(curve, Path::Translation, 1.0).x, 0.0);
    EXPECT_EQ(value_at(curve, Path::Translation, 1.999).x, 0.0);
    EXPECT_EQ(value_at(curve, Path::Translation, 2.0).x, 4.0);
    EXPECT_EQ(value_at(curve, Path::Translation, 9.0).x, 8.0);
}

TEST(Curve, LinearInterpolatesBetweenKeys) {
    const Curve curve = ramp_curve(Interpolation::Linear);
    EXPECT_EQ(value_at(curve, Path::Scale, 1.25), glm::dvec4(1.0, 1.0, 1.5, 0.0));
    EXPECT_EQ(value_at(curve, Path::Scale, 3.0), glm::dvec4(6.0, 2.0, 0.0, 0.0));
}

TEST(Curve, ClampsToItsFirstAndLastValue) {
    for (const Interpolation interpolation : {Interpolation::Step, Interpolation::Linear}) {
        const Curve curve = ramp_curve(interpolation);
        for (const double before : {-1e300, -1.0, 0.0, 0.999, std::numeric_limits<double>::quiet_NaN()}) {
            EXPECT_EQ(value_at(curve, Path::Translation, before).z, 2.0);
        }
        for (const double after : {4.0, 4.001, 1e300}) {
            EXPECT_EQ(value_at(curve, Path::Translation, after).x, 8.0);
        }
    }
}

TEST(Curve, SingleKeyIsConstant) {
    const Curve line{
        .interpolation = Interpolation::Linear, .times_s = {0.5F}, .values = {{3.0F, 0.0F, 0.0F, 0.0F}}};
    const Curve spline{.interpolation = Interpolation::CubicSpline,
                       .times_s = {0.5F},
                       .values = {glm::vec4(9.0F), {3.0F, 0.0F, 0.0F, 0.0F}, glm::vec4(7.0F)}};
    for (const double seconds : {0.0, 0.5, 2.0}) {
        EXPECT_EQ(value_at(line, Path::Translation, seconds).x, 3.0);
        EXPECT_EQ(value_at(spline, Path::Translation, seconds).x, 3.0);
    }
}

TEST(Curve, CubicSplineScalesItsTangentsByTheInterval) {
    // From 1 to 3 in 2 s; the first key's leaving tangent is 2 a second, the second's coming one -1 a second.
    const Curve curve{.interpolation = Interpolation::CubicSpline,
                      .times_s = {1.0F, 3.0F},
                      .values = {glm::vec4(100.0F), glm::vec4(1.0F), glm::vec4(2.0F), glm::vec4(-1.0F),
                                 glm::vec4(3.0F), glm::vec4(100.0F)}};
    // t = 1/2: 1/2 * 1 + 2 * 1/8 * 2 + 1/2 * 3 + 2 * (-1/8) * (-1) = 2.75
    EXPECT_DOUBLE_EQ(value_at(curve, Path::Light, 2.0).y, 2.75);
    // t = 1/4: 27/32 * 1 + 2 * 9/64 * 2 + 5/32 * 3 + 2 * (-3/64) * (-1) = 1.96875
    EXPECT_DOUBLE_EQ(value_at(curve, Path::Light, 1.5).y, 1.96875);
    // The slope at the first key is the leaving tangent.
    EXPECT_NEAR((value_at(curve, Path::Light, 1.0 + 1e-6).x - 1.0) / 1e-6, 2.0, 1e-5);
    EXPECT_NEAR((3.0 - value_at(curve, Path::Light, 3.0 - 1e-6).x) / 1e-6, -1.0, 1e-5);
}

TEST(Curve, RotationsTurnAtConstantSpeed) {
    const Curve curve{.interpolation = Interpolation::Linear,
                      .times_s = {0.0F, 1.0F},
                      .values = {turned(10.0), turned(130.0)}};
    for (double t = 0.0; t <= 1.0; t += 0.05) {
        const glm::dvec4 rotation = value_at(curve, Path::Rotation, t);
        EXPECT_NEAR(degrees_about_z(rotation), 10.0 + 120.0 * t, 1e-5); // a float's digits
        EXPECT_NEAR(glm::length(rotation), 1.0, 1e-15);
    }
}

TEST(Curve, RotationsTurnTheShorterWay) {
    const Curve curve{.interpolation = Interpolation::Linear,
                      .times_s = {0.0F, 1.0F},
                      .values = {turned(0.0), -turned(60.0)}}; // the same rotation with the other sign
    EXPECT_NEAR(degrees_about_z(value_at(curve, Path::Rotation, 0.5)), 30.0, 1e-5);
    const Curve back{.interpolation = Interpolation::Linear,
                     .times_s = {0.0F, 1.0F},
                     .values = {turned(0.0), turned(300.0)}};
    EXPECT_NEAR(degrees_about_z(value_at(back, Path::Rotation, 0.5)), -30.0, 1e-5);
}

TEST(Curve, RotationsHandleEqualNearAndOppositeKeys) {
    for (const double degrees : {0.0, 1e-6, 1e-3, 179.999, 180.0}) {
        const Curve curve{.interpolation = Interpolation::Linear,
                          .times_s = {0.0F, 1.0F},
                          .values = {turned(0.0), turned(degrees)}};
        const glm::dvec4 half = value_at(curve, Path::Rotation, 0.5);
        EXPECT_NEAR(glm::length(half), 1.0, 1e-15);
        EXPECT_NEAR(std::abs(degrees_about_z(half)), 0.5 * degrees, 1e-5);
    }
}

TEST(Curve, RotationsNormaliseKeysAndSplines) {
    const Curve curve{.interpolation = Interpolation::CubicSpline,
                      .times_s = {0.0F, 1.0F},
                      .values = {glm::vec4(0.0F), 3.0F * turned(0.0), glm::vec4(0.0F), glm::vec4(0.0F),
                                 0.1F * turned(90.0), glm::vec4(0.0F)}};
    const glm::dvec4 half = value_at(curve, Path::Rotation, 0.5);
    EXPECT_NEAR(glm::length(half), 1.0, 1e-15);
    EXPECT_NEAR(degrees_about_z(half), 45.0, 1e-5);
    // A spline through no rotation at all keeps the nearer key's.
    const Curve through{.interpolation = Interpolation::CubicSpline,
                        .times_s = {0.0F, 1.0F},
                        .values = {glm::vec4(0.0F), turned(0.0), glm::vec4(0.0F), glm::vec4(0.0F),
                                   -turned(0.0), glm::vec4(0.0F)}};
    EXPECT_EQ(std::abs(value_at(through, Path::Rotation, 0.5).w), 1.0);
}

TEST(Curve, IsExactForKeysANanosecondApart) {
    const Curve curve{.interpolation = Interpolation::Linear,
                      .times_s = {0.0F, 1e-9F, 2e-9F},
                      .values = {glm::vec4(0.0F), glm::vec4(1.0F), glm::vec4(0.0F)}};
    EXPECT_NEAR(value_at(curve, Path::Translation, 0.5e-9).x, 0.5, 1e-7); // the float of 1e-9
    EXPECT_NEAR(value_at(curve, Path::Translation, 1.5e-9).x, 0.5, 1e-6);
    EXPECT_EQ(value_at(curve, Path::Translation, 1e-3).x, 0.0);
}

} // namespace
} // namespace frustumscreen::world
