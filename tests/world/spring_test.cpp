// Springs against integration in long double with short steps, and against cases that have a plain solution.

#include "app/world/spring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustumscreen::world {
namespace {

struct Exact {
    long double x, v;
};

/// Runge and Kutta's fourth order, in `count` steps.
Exact integrated(const SpringLaw& law, const Motion& start, long double seconds, int count) {
    const long double k = law.stiffness_per_s2;
    const long double c = law.damping_per_s;
    const auto slope = [&](const Exact& at) { return Exact{at.v, -k * at.x - c * at.v}; };
    const auto moved = [](const Exact& at, const Exact& by, long double dt) {
        return Exact{at.x + dt * by.x, at.v + dt * by.v};
    };
    Exact at{start.x, start.v};
    const long double dt = seconds / count;
    for (int step = 0; step < count; ++step) {
        const Exact a = slope(at);
        const Exact b = slope(moved(at, a, dt / 2));
        const Exact d = slope(moved(at, b, dt / 2));
        const Exact e = slope(moved(at, d, dt));
        at = moved(at, {a.x + 2 * b.x + 2 * d.x + e.x, a.v + 2 * b.v + 2 * d.v + e.v}, dt / 6);
    }
    return at;
}

TEST(Spring, MatchesNumericalIntegration) {
    for (const double stiffness : {1e-3, 1.0, 100.0, 1e6, 1e9}) {
        const double rate = std::sqrt(stiffness);
        for (const double ratio : {0.0, 0.01, 0.3, 0.999, 1.0, 1.001, 3.0, 20.0}) {
            const SpringLaw law{stiffness, 2.0 * ratio * rate};
            const Motion start{0.7, -0.4 * rate};
            for (const double own_times : {0.1, 1.0, 5.0}) {
                const double seconds = own_times / rate;
                const Exact exact = integrated(law, start, seconds, 20'000);
                const Motion motion = motion_after(law, start, seconds);
                EXPECT_NEAR(motion.x, static_cast<double>(exact.x), 1e-13) << stiffness << " " << ratio;
                EXPECT_NEAR(motion.v / rate, static_cast<double>(exact.v) / rate, 1e-13);
            }
        }
    }
}

TEST(Spring, UndampedMotionIsACosine) {
    const SpringLaw law{4.0 * std::numbers::pi * std::numbers::pi, 0.0}; // a second a swing
    EXPECT_NEAR(motion_after(law, {1.0, 0.0}, 0.25).x, 0.0, 1e-15);
    EXPECT_NEAR(motion_after(law, {1.0, 0.0}, 0.5).x, -1.0, 1e-15);
    EXPECT_NEAR(motion_after(law, {1.0, 0.0}, 86'400.0).x, 1.0, 1e-9);
}

TEST(Spring, MatchesTheClosedFormAtCriticalDamping) {
    // x = (1 + w t) exp(-w t), v = -w^2 t exp(-w t)
    const double w = 10.0;
    for (const double t : {1e-6, 0.01, 0.1, 1.0, 10.0}) {
        const double decay = std::exp(-w * t);
        for (const double off : {0.0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-9, -1e-9}) {
            const Motion motion = motion_after({w * w, 2.0 * w * (1.0 + off)}, {1.0, 0.0}, t);
            const double slack = 1e-15 + 2.0 * std::abs(off);
            EXPECT_NEAR(motion.x, (1.0 + w * t) * decay, slack);
            EXPECT_NEAR(motion.v, -w * w * t * decay, w * slack);
        }
    }
}

TEST(Spring, CreepsFarAboveCriticalDamping) {
    // The slow part of x: exp(-stiffness / damping t), to first order.
    const Motion motion = motion_after({1.0, 1e9}, {1.0, 0.0}, 1e9);
    EXPECT_NEAR(motion.x, std::exp(-1.0), 1e-9);
    EXPECT_NEAR(motion.v, -1e-9 * std::exp(-1.0), 1e-18);
}

TEST(Spring, DoesNotMoveForZeroOrNegativeTime) {
    for (const double seconds : {0.0, -1.0, std::nan("")}) {
        const Motion motion = motion_after({10.0, 1.0}, {0.3, 0.2}, seconds);
        EXPECT_EQ(motion.x, 0.3);
        EXPECT_EQ(motion.v, 0.2);
    }
}

TEST(Spring, PushFromRestReachesTheRequestedDistance) {
    for (const double damping : {0.0, 0.1, 1.0, 19.99, 20.0, 20.01, 50.0, 1e4}) {
        const SpringLaw law{100.0, damping};
        const Motion start{0.0, speed_to_reach(law, 0.25)};
        double farthest = 0.0;
        for (int k = 0; k <= 200'000; ++k) {
            farthest = std::fmax(farthest, motion_after(law, start, k * 5e-6).x);
        }
        EXPECT_NEAR(farthest, 0.25, 1e-8) << damping;
    }
}

TEST(Spring, NeverSwingsFartherThanItsEnergyAllows) {
    for (const double damping : {0.0, 0.2, 2.0, 6.0, 100.0}) {
        const SpringLaw law{9.0, damping};
        const Motion start{0.4, -2.0};
        double before = swing_of(law, start);
        for (int k = 1; k < 3000; ++k) {
            const Motion motion = motion_after(law, start, 0.01 * k);
            EXPECT_LE(std::abs(motion.x), swing_of(law, start) * (1.0 + 1e-15));
            EXPECT_LE(swing_of(law, motion), before * (1.0 + 1e-14));
            before = swing_of(law, motion);
        }
    }
}

} // namespace
} // namespace frustumscreen::world
