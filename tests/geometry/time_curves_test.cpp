#include "app/geometry/time_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace frustumscreen::geometry {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(FollowShare, IsExactForOneStepAndForMany) {
    EXPECT_NEAR(follow_share(0.2, 0.2), 1.0 - std::exp(-1.0), 1e-15);
    double left = 1.0;
    for (int k = 0; k < 1000; ++k) {
        left *= 1.0 - follow_share(1e-3, 0.5);
    }
    EXPECT_NEAR(1.0 - left, follow_share(1.0, 0.5), 1e-13);
}

TEST(FollowShare, KeepsItsDigitsForTheShortestSteps) {
    EXPECT_NEAR(follow_share(1e-9, 1e3) / 1e-12, 1.0, 1e-12);
}

TEST(FollowShare, IsZeroForInvalidOrNonPositiveTime) {
    EXPECT_EQ(follow_share(0.0, 1.0), 0.0);
    EXPECT_EQ(follow_share(-10.0, 1.0), 0.0);
    EXPECT_EQ(follow_share(nan, 1.0), 0.0);
    EXPECT_EQ(follow_share(1.0, 0.0), 1.0);
}

TEST(Ramp, RunsFromZeroToOneAndStaysThere) {
    EXPECT_EQ(ramp(-1.0, 0.4), 0.0);
    EXPECT_EQ(ramp(nan, 0.4), 0.0);
    EXPECT_EQ(ramp(0.1, 0.4), 0.25);
    EXPECT_EQ(ramp(0.4, 0.4), 1.0);
    EXPECT_EQ(ramp(1e9, 0.4), 1.0);
    EXPECT_EQ(ramp(1e-9, 0.0), 1.0);
}

TEST(Ease, IsSymmetricAndBeginsAndEndsAtRest) {
    EXPECT_EQ(ease(-1.0), 0.0);
    EXPECT_EQ(ease(2.0), 1.0);
    for (double x = 0.0; x <= 1.0; x += 0.01) {
        EXPECT_NEAR(ease(1.0 - x), 1.0 - ease(x), 1e-15);
    }
    EXPECT_LT(ease(1e-6), 4e-12);
}

} // namespace
} // namespace frustumscreen::geometry
