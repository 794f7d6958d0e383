// The torch's filter against a simulated hand: what a tremor leaves of the light's place, what a sweep costs, and the same
// of the prop's filter.
#include "app/tracking/held_filter.h"
#include "app/tracking/pose_math.h"
#include "app/tracking/steady_filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>

namespace frustumscreen::tracking {
namespace {

constexpr double throw_m = 0.4;   ///< from the torch to what it lights
constexpr double ahead_s = 0.035; ///< tracker, display and half a frame

using Motion = std::function<geometry::RigidTransform(double)>;

/// Points down at the table, and trembles: five sines from 4 to 12 Hz about each axis, together 0.25 degrees and 0.3 mm
/// RMS on each.
geometry::RigidTransform trembles(double t_s) {
    constexpr std::array hz{4.3, 5.9, 7.7, 9.1, 11.6};
    PoseStep step;
    for (std::size_t k = 0; k < hz.size(); ++k) {
        for (int axis = 0; axis < 3; ++axis) {
            const double wave =
                std::sqrt(2.0 / hz.size()) *
                std::sin(2.0 * std::numbers::pi * hz.at(k) * t_s + 2.4 * axis + 1.3 * static_cast<double>(k));
            step.turn_rad[axis] += glm::radians(0.25) * wave;
            step.shift_m[axis] += 0.0003 * wave;
        }
    }
    return moved({glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, throw_m}}, step);
}
/// Stands, then turns at 60 degrees a second, as a hand does from 1 s on.
geometry::RigidTransform sweeps(double t_s) {
    const double angle = glm::radians(60.0) * std::fmax(0.0, t_s - 1.0);
    return {rotation_of({angle, 0.0, 0.0}) * glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, throw_m}};
}

glm::dvec3 light(const geometry::RigidTransform& pose) {
    return pose.point({0.0, 0.0, throw_m});
}

/// Calls `look` with the filter's pose and the true one at the time at which the picture is lit.
void follow(PoseFilter& filter, const Motion& motion, double rate_hz, double seconds, const auto& look) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    const auto any = [&] {
        const double x = normal(random), y = normal(random);
        return glm::dvec3(x, y, normal(random));
    };
    for (int k = 0; k < seconds * rate_hz; ++k) {
        const double t_s = k / rate_hz;
        const geometry::RigidTransform measured =
            moved(motion(t_s), {PoseNoise().place_m * any(), PoseNoise().turn_rad * any()});
        if (k == 0) {
            filter.restart(measured);
        } else {
            filter.take(measured, 1.0 / rate_hz);
        }
        look(t_s, filter.ahead(ahead_s), motion(t_s + ahead_s));
    }
}

double tremor_mm(PoseFilter& filter, double rate_hz) {
    const glm::dvec3 aim(0.0);
    double sum = 0.0;
    int count = 0;
    follow(filter, trembles, rate_hz, 11.0, [&](double t_s, const auto& shown, const auto&) {
        if (t_s >= 1.0) {
            const glm::dvec3 off = light(shown) - aim;
            sum += glm::dot(off, off);
            ++count;
        }
    });
    EXPECT_GT(count, 9 * rate_hz);
    return 1e3 * std::sqrt(sum / count);
}

/// The lag of the light, in a sweep that has gone on for 0.4 s: behind the true one, at the sweep's speed.
double lag_ms(PoseFilter& filter, double rate_hz) {
    double sum = 0.0;
    int count = 0;
    follow(filter, sweeps, rate_hz, 2.0, [&](double t_s, const auto& shown, const auto& truth) {
        if (t_s >= 1.4) {
            const PoseStep behind = step_between(shown, truth);
            sum += behind.turn_rad.x / glm::radians(60.0);
            ++count;
        }
    });
    EXPECT_GT(count, 10);
    return 1e3 * sum / count;
}

TEST(SteadyFilter, ReducesTremorAndLagsLessThanAFrame) {
    for (const double rate_hz : {30.0, 60.0, 120.0, 240.0}) {
        SteadyFilter steady, steady_sweeps;
        HeldFilter held(PoseNoise{}, 0.06);
        const double steady_mm = tremor_mm(steady, rate_hz), held_mm = tremor_mm(held, rate_hz);
        const double lag = lag_ms(steady_sweeps, rate_hz);
        EXPECT_LT(steady_mm, 0.4 * held_mm) << rate_hz;
        EXPECT_LT(std::fabs(lag), 17.0) << rate_hz;
    }
}

TEST(SteadyFilter, ConvergesToTheTarget) {
    SteadyFilter filter;
    const geometry::RigidTransform from{glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, throw_m}};
    const geometry::RigidTransform to = moved(from, {{0.1, -0.05, 0.02}, {0.3, 0.1, 0.5}});
    filter.restart(from);
    for (int k = 0; k < 240; ++k) {
        filter.take(to, 1.0 / 120.0);
    }
    EXPECT_LT(glm::length(step_between(filter.ahead(0.0), to).shift_m), 1e-6);
    EXPECT_LT(glm::length(step_between(filter.ahead(ahead_s), to).turn_rad), 1e-5);
}

/// A sweep that ends at once goes on by what was predicted, and by what it takes to see that the motion is over.
TEST(SteadyFilter, OvershootsLittleWhenASweepEnds) {
    SteadyFilter filter;
    const Motion stops = [](double t_s) { return sweeps(std::fmin(t_s, 1.5)); };
    double farthest = 0.0;
    follow(filter, stops, 120.0, 3.0, [&](double t_s, const auto& shown, const auto& truth) {
        if (t_s > 1.5) {
            farthest = std::fmax(farthest, -step_between(shown, truth).turn_rad.x);
        }
    });
    constexpr double until_seen_s = 0.04; // half of the velocity's time constant
    EXPECT_LT(glm::degrees(farthest), 60.0 * (ahead_s + until_seen_s));
}

} // namespace
} // namespace frustumscreen::tracking
