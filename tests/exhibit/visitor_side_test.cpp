#include "app/typography/visitor_side.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustumscreen::exhibit {
namespace {

/// The eye's position, counter-clockwise from the front edge.
glm::dvec3 eye_at(double degrees_from_front, double distance_m = 0.8) {
    const double azimuth = (degrees_from_front - 90.0) * std::numbers::pi / 180.0;
    return {distance_m * std::cos(azimuth), distance_m * std::sin(azimuth), 0.5};
}

TEST(VisitorSide, StartsAtTheFirstVisitorsSide) {
    for (int side = 0; side < 4; ++side) {
        for (const double off : {-40.0, 0.0, 40.0}) {
            typography::VisitorSide visitor;
            EXPECT_EQ(visitor.update(eye_at(90.0 * side + off)), side) << off;
        }
    }
}

TEST(VisitorSide, FollowsTheVisitorInBothDirections) {
    typography::VisitorSide visitor;
    int turns = 0;
    int before = visitor.update(eye_at(0.0));
    for (int k = 0; k <= 2 * 720; ++k) {
        const double degrees = k <= 720 ? k : 1440 - k;
        const int side = visitor.update(eye_at(degrees));
        const double off = std::remainder(degrees - 90.0 * side, 360.0);
        EXPECT_LE(std::abs(off), 45.0 + typography::VisitorSide::hysteresis_deg + 1.0) << degrees;
        turns += side != before ? 1 : 0;
        before = side;
    }
    EXPECT_EQ(turns, 16);
}

TEST(VisitorSide, StaysWhileAVisitorStandsAtACorner) {
    for (int side = 0; side < 4; ++side) {
        typography::VisitorSide visitor;
        visitor.update(eye_at(90.0 * side));
        for (int k = 0; k < 200; ++k) {
            const double sway = 10.0 * std::sin(0.7 * k);
            EXPECT_EQ(visitor.update(eye_at(90.0 * side + 45.0 + sway)), side);
        }
    }
}

TEST(VisitorSide, StaysWhileAVisitorLeansOverTheMiddle) {
    typography::VisitorSide visitor;
    visitor.update(eye_at(180.0));
    for (int k = 0; k < 360; ++k) {
        EXPECT_EQ(visitor.update(eye_at(k, 0.1)), 2);
    }
}

} // namespace
} // namespace frustumscreen::exhibit
