// Glasses that lie or are worn, and the way between one eye and two, with a simulated clock.
#include "app/tracking/eyes_apart.h"
#include "app/tracking/pose_math.h"
#include "app/tracking/worn_glasses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace frustumscreen::tracking {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

geometry::RigidTransform placed(double x_m, double yaw_rad = 0.0) {
    return {rotation_of({0.0, 0.0, yaw_rad}), {x_m, 0.2, 0.01}};
}

MonotonicTime at(int ms) {
    return MonotonicTime(milliseconds(ms));
}

TEST(WornGlasses, LieAfterBeingStillAtAnySampleRate) {
    constexpr int still_ms = 6000;
    static_assert(WornGlasses::still_for == milliseconds(still_ms));
    for (const int step_ms : {1, 8, 16, 33, 250}) {
        WornGlasses glasses;
        int first_lying = 0;
        for (int ms = 0; ms < 20'000 && first_lying == 0; ms += step_ms) {
            first_lying = glasses.worn(at(ms), placed(0.3)) ? 0 : ms;
        }
        EXPECT_GE(first_lying, still_ms) << step_ms;
        EXPECT_LT(first_lying, still_ms + step_ms) << step_ms;
    }
}

/// The movement counts at `lever_m` from the sensor: a shift as it is, a turn times the lever.
TEST(WornGlasses, OnlyMovesBeyondTheThresholdCount) {
    constexpr double within = 0.999;
    constexpr double beyond = 1.001;
    const double shift = WornGlasses::still_m;
    const double turn = WornGlasses::still_m / WornGlasses::lever_m;
    for (const auto& [x, yaw, moves] : {std::tuple{shift * within, 0.0, false},
                                        {shift * beyond, 0.0, true},
                                        {0.0, turn * within, false},
                                        {0.0, turn * beyond, true},
                                        {0.6 * shift, 0.6 * turn, true}}) {
        WornGlasses glasses;
        for (int ms = 0; ms <= 7000; ms += 10) {
            static_cast<void>(glasses.worn(at(ms), placed(0.0)));
        }
        bool worn = false;
        for (int ms = 7010; ms <= 12'000; ms += 10) { // ten time constants
            worn = glasses.worn(at(ms), placed(x, yaw));
        }
        EXPECT_EQ(worn, moves) << x << " m, " << yaw << " rad";
    }
}

/// A slow drift of the tracker's field, 0.3 mm in a minute, is no movement; a slow movement is one.
TEST(WornGlasses, SlowMovesCountButDriftDoesNot) {
    for (const auto& [m_per_s, lies] : {std::pair{0.3e-3 / 60.0, true}, {0.3e-3, false}}) {
        WornGlasses glasses;
        bool worn = true;
        for (int ms = 0; ms < 60'000; ms += 16) {
            worn = glasses.worn(at(ms), placed(m_per_s * 1e-3 * ms));
        }
        EXPECT_EQ(worn, !lies) << m_per_s;
    }
}

TEST(WornGlasses, RestartAfterALoss) {
    WornGlasses glasses;
    static_cast<void>(glasses.worn(at(0), placed(0.0)));
    EXPECT_FALSE(glasses.worn(at(7000), placed(0.0)));
    glasses.forget();
    EXPECT_TRUE(glasses.worn(at(9000), placed(0.0)));
    EXPECT_FALSE(glasses.worn(at(15'000), placed(0.0)));
}

/// The closed form: a smooth step of half a second, from whichever end it begins.
TEST(EyesApart, BlendSmoothlyAtAnyStepLength) {
    for (const bool both : {true, false}) {
        for (const int step_ms : {1, 4, 10, 20, 50, 125, 500}) {
            EyesApart eyes(!both);
            EXPECT_EQ(eyes.follow(at(0), !both), both ? 0.0 : 1.0);
            for (int ms = step_ms; ms <= 1000; ms += step_ms) {
                const double x = std::min(ms / 500.0, 1.0);
                const double share = x * x * (3.0 - 2.0 * x);
                EXPECT_NEAR(eyes.follow(at(ms), both), both ? share : 1.0 - share, 1e-12) << ms;
            }
            EXPECT_EQ(eyes.follow(at(2000), both), both ? 1.0 : 0.0) << "the picture could not rest";
        }
    }
}

TEST(EyesApart, ReverseDuringABlendWithoutAJump) {
    constexpr double steepest = 1.5 / 500.0; // of a smooth step, each millisecond
    EyesApart eyes(true);
    double before = eyes.follow(at(0), true);
    double lowest = 1.0;
    for (int ms = 1; ms < 4000; ++ms) {
        const bool both = ms / 170 % 2 == 0 || ms > 3000;
        const double share = eyes.follow(at(ms), both);
        EXPECT_LE(std::abs(share - before), steepest * 1.001) << ms;
        before = share;
        lowest = std::min(lowest, share);
    }
    EXPECT_LT(lowest, 0.9);
    EXPECT_EQ(before, 1.0);
}

TEST(EyesApart, IgnoreATimeThatGoesBack) {
    EyesApart eyes(false);
    static_cast<void>(eyes.follow(at(1000), true));
    const double share = eyes.follow(at(1200), true);
    EXPECT_EQ(eyes.follow(at(300), true), share);
    EXPECT_EQ(eyes.follow(at(1200), true), share) << "the time that went back was counted twice";
}

} // namespace
} // namespace frustumscreen::tracking
