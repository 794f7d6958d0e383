// First-order followers: the closed form itself, and the model of frame times that uses it.

#include "app/bench/stability/sweep.h"
#include "app/bench/stability/themes.h"
#include "app/geometry/time_curves.h"
#include "app/scene/frame_time_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace frustumscreen::bench {

namespace {

constexpr double eps = 0x1p-52;

double exact_share(double dt, double time_constant) {
    return static_cast<double>(-std::expm1(-static_cast<long double>(dt) / time_constant));
}

StabilityResult closed_form(const StabilityOptions&) {
    double off = 0.0;
    double outside = 0.0;
    double falling = 0.0;
    for (const double tau : sweep(1e-6, 1e3, 10)) {
        double before = 0.0;
        for (const double dt : sweep(1e-6, 10.0, 10)) {
            const double share = geometry::follow_share(dt, tau);
            off = std::fmax(off, std::abs(share / exact_share(dt, tau) - 1.0));
            outside += share >= 0.0 && share <= 1.0 ? 0.0 : 1.0;
            falling += share >= before ? 0.0 : 1.0;
            before = share;
        }
        for (const double dt : {0.0, -1e-9, -10.0}) {
            outside += geometry::follow_share(dt, tau) == 0.0 ? 0.0 : 1.0;
        }
    }
    return {{{"share of the way off, relative", 4 * eps, off},
             {"shares outside 0..1, or not 0 for steps of 0 and less", 0.0, outside},
             {"longer steps that go less far", 0.0, falling}}};
}

/// The value after `count` steps towards a target that jumps from 0 to 1.
double stepped(double dt, double tau, int count) {
    double x = 0.0;
    for (int k = 0; k < count; ++k) {
        x += geometry::follow_share(dt, tau) * (1.0 - x);
    }
    return x;
}

int steps_in(double time, double step) {
    return static_cast<int>(std::clamp(std::round(time / step), 1.0, 1e5));
}

StabilityResult step_response(const StabilityOptions&) {
    double off_per_step = 0.0;
    for (const double tau : sweep(1e-6, 1e3, 1)) {
        for (const double dt : sweep(1e-6, 10.0, 1)) {
            const int count = steps_in(tau, dt);
            const double exact = exact_share(dt * count, tau);
            off_per_step = std::fmax(off_per_step, std::abs(stepped(dt, tau, count) - exact) / count);
        }
    }
    return {{{"off the exact response, of each step, of 1", eps, off_per_step}}};
}

/// Targets that jump at every step, in -1..1: the follower stays in this range.
StabilityResult no_overshoot(const StabilityOptions&) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> goal(-1.0, 1.0);
    double beyond = 0.0;
    for (const double tau : sweep(1e-6, 1e3, 1)) {
        for (const double dt : sweep(1e-6, 10.0, 1)) {
            double x = 0.0;
            for (int k = 0; k < 1000; ++k) {
                const double to = k % 2 == 0 ? std::copysign(1.0, goal(random)) : goal(random);
                const double before = x;
                x += geometry::follow_share(dt, tau) * (to - x);
                beyond = std::fmax(beyond, std::fmax(x - std::fmax(before, to), std::fmin(before, to) - x));
            }
        }
    }
    return {{{"beyond goal and start, of 1", eps, beyond}}};
}

MonotonicTime at_seconds(double seconds) {
    return MonotonicTime(Nanoseconds(std::llround(seconds * 1e9)));
}

constexpr scene::FrameWork usual_work{1e4, 1e5};
scene::FrameTimeModel model_of(std::size_t quality_levels) {
    return scene::FrameTimeModel(
        std::vector<scene::QualityLevelTime>(quality_levels, {.samples = 1, .work = usual_work, .ms = 10.0}));
}

/// The load doubles. log2 of the expected time over the old one is compared with 1 - exp(-t / time constant).
struct LoadResponse {
    double off = 0.0;
    double back = 0.0; ///< falls, or overshoots the target
    int count = 0;     ///< number of steps
};
LoadResponse load_response(double dt) {
    const Nanoseconds step(std::llround(dt * 1e9));
    scene::FrameTimeModel model = model_of(1);
    (void)model.observe(0, usual_work, 10.0, at_seconds(0.0));
    LoadResponse response;
    response.count = steps_in(scene::FrameTimeModel::time_constant_s, dt);
    double before = 0.0;
    for (int k = 1; k <= response.count; ++k) {
        (void)model.observe(0, usual_work, 20.0, MonotonicTime(k * step));
        const double now = std::log2(model.expected_ms(0) / 10.0);
        response.back = std::fmax(response.back, std::fmax(before - now, now - 1.0));
        before = now;
    }
    // A step counts with its duration, limited to max_dt_s.
    const double counted = std::fmin(to_seconds(step), scene::FrameTimeModel::max_dt_s);
    response.off =
        std::abs(before - exact_share(counted * response.count, scene::FrameTimeModel::time_constant_s));
    return response;
}

constexpr std::array frame_steps{1e-6, 1e-5, 1e-4, 1e-3, 1.0 / 240.0, 1.0 / 60.0, 0.05, 0.1, 1.0, 10.0};

/// A step's sum is below 1, so it is rounded by at most a quarter of eps, and its share by as much.
constexpr double rounding_of_step = 0.5 * eps;

StabilityResult load_responses(const StabilityOptions&) {
    double off = 0.0;
    double back = 0.0;
    for (const double dt : frame_steps) {
        const LoadResponse response = load_response(dt);
        off = std::fmax(off, response.off / (4.0 + response.count));
        back = std::fmax(back, response.back);
    }
    return {{{"steps of 1 us to 10 s: off the exact response, of each step", rounding_of_step, off},
             {"back, or beyond the goal", 8 * eps, back}}};
}

/// One quality level is twice as slow as measured: first only its own factor learns this, then the load
/// gradually takes it over. The level's expected time is exact at any step; the share of the load begins to
/// grow at learning_s, to within one step.
StabilityResult quality_level_response(const StabilityOptions&) {
    StabilityResult result;
    double off = 0.0;
    double off_shared = 0.0;
    const auto share_at = [](double dt, double seconds) {
        scene::FrameTimeModel model = model_of(2);
        (void)model.observe(0, usual_work, 10.0, at_seconds(0.0));
        const auto step = Nanoseconds(std::llround(dt * 1e9));
        for (Nanoseconds t = step; t <= Nanoseconds(std::llround(seconds * 1e9)); t += step) {
            (void)model.observe(1, usual_work, 20.0, MonotonicTime(t));
        }
        return std::pair{std::log2(model.expected_ms(1) / 10.0), std::log2(model.expected_ms(0) / 10.0)};
    };
    constexpr double seconds = 2.0;
    const double total = exact_share(seconds, scene::FrameTimeModel::time_constant_s);
    // The factor is learnt in learning_s, then it decays.
    const double own =
        exact_share(scene::FrameTimeModel::learning_s, scene::FrameTimeModel::time_constant_s) *
        std::exp(-(seconds - scene::FrameTimeModel::learning_s) / scene::FrameTimeModel::forgetting_s);
    for (const double dt : {1e-5, 1e-4, 1e-3, 0.01, 0.1}) {
        const auto [drawn, other] = share_at(dt, seconds);
        off = std::fmax(off, std::abs(drawn - total) / (seconds / dt));
        const double one_step = exact_share(2.0 * dt, scene::FrameTimeModel::time_constant_s);
        off_shared = std::fmax(off_shared, std::abs(other - (total - own)) / one_step);
    }
    result.rows.push_back(
        {"expected of the level: off the exact response, of each step", rounding_of_step, off});
    result.rows.push_back({"expected of the others: off, in shares of two steps", 0.2, off_shared});
    return result;
}

/// Arbitrary times in any rhythm: the expected time stays a number within the limits of load and level.
StabilityResult garbage(const StabilityOptions&) {
    scene::FrameTimeModel model = model_of(3);
    std::mt19937 random(12);
    std::uniform_real_distribution<double> exponent(-12.0, 12.0);
    constexpr double inf = std::numeric_limits<double>::infinity();
    const std::array<Nanoseconds, 6> odd{Nanoseconds(0),
                                         Nanoseconds(1),
                                         Nanoseconds(-1),
                                         std::chrono::seconds(10),
                                         std::chrono::seconds(-10),
                                         std::chrono::milliseconds(16)};
    MonotonicTime now;
    double wrong = 0.0;
    for (int k = 0; k < 200'000; ++k) {
        now += odd[random() % odd.size()];
        double ms = std::pow(10.0, exponent(random));
        switch (random() % 8) {
        case 0:
            ms = std::numeric_limits<double>::quiet_NaN();
            break;
        case 1:
            ms = inf;
            break;
        case 2:
            ms = -ms;
            break;
        case 3:
            ms = 0.0;
            break;
        default:
            break;
        }
        const scene::FrameWork work{std::pow(10.0, exponent(random)), random() % 2 == 0 ? inf : 0.0};
        const bool taken = model.observe(random() % 3, work, ms, now);
        wrong += taken == (ms > 0.0 && ms <= scene::FrameTimeModel::longest_ms) ? 0.0 : 1.0;
        for (std::size_t quality_level = 0; quality_level < 3; ++quality_level) {
            const double expected = model.expected_ms(quality_level);
            // Work within a factor of 20, load and own factor within e^7 each.
            const double most = 10.0 * 20.0 * std::exp(14.0) * 1.0001;
            wrong += expected > 0.0 && expected <= most && expected >= 100.0 / most ? 0.0 : 1.0;
        }
    }
    return {{{"of 200000 frames: taken wrongly, or expectations beyond e^14 x 20", 0.0, wrong}}};
}

} // namespace

std::vector<StepError> smoother_step_errors() {
    std::vector<StepError> errors;
    struct Method {
        std::string name;
        double (*share)(double);
    };
    const std::array methods{
        Method{"follow_share (exact)", [](double h) { return geometry::follow_share(h, 1.0); }},
        Method{"implicit Euler", [](double h) { return h / (1.0 + h); }},
        Method{"explicit Euler", [](double h) { return h; }}};
    for (const Method& method : methods) {
        for (const double h : sweep(1e-5, 1e7, 2)) {
            const int count = steps_in(1.0, h);
            double x = 0.0;
            for (int k = 0; k < count; ++k) {
                x += method.share(h) * (1.0 - x);
            }
            errors.push_back({method.name, h, std::abs(x - exact_share(h * count, 1.0))});
        }
    }
    return errors;
}

std::vector<StepError> frame_time_step_errors() {
    std::vector<StepError> errors;
    errors.reserve(frame_steps.size());
    for (const double dt : frame_steps) {
        errors.push_back({"modelled load, of 1", dt, load_response(dt).off});
    }
    return errors;
}

std::vector<StabilityCase> smoother_cases() {
    const std::string theme = "smoother";
    return {{theme, "closed form, time constants 1 us to 1e3 s, steps 1 us to 10 s", FloatingPoint::Strict,
             closed_form},
            {theme, "step response, the same", FloatingPoint::Strict, step_response},
            {theme, "goals that jump, the same", FloatingPoint::Strict, no_overshoot},
            {theme, "frame times: the load doubles", FloatingPoint::Strict, load_responses},
            {theme, "frame times: a quality level was measured wrong", FloatingPoint::Strict,
             quality_level_response},
            {theme, "frame times: garbage", FloatingPoint::Free, garbage}};
}

} // namespace frustumscreen::bench
