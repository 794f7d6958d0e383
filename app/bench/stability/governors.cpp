// The governor in a closed loop with a simulated GPU without noise, at steps of 1 us to 10 s.

#include "app/bench/stability/sweep.h"
#include "app/bench/stability/themes.h"
#include "app/scene/governor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace frustumscreen::bench {

namespace {

constexpr double deadline_ms = 1000.0 / 60.0;

/// A GPU whose frames take 0.5 ms, 1e-4 ms per triangle and 2e-5 ms per sample.
struct Gpu {
    std::vector<scene::QualityLevel> quality_levels;
    std::vector<scene::QualityLevelTime> times;

    Gpu() {
        for (const auto& [level, triangles] : {std::pair{1U, 4e4}, std::pair{0U, 1e4}}) {
            for (const int samples : {4, 2, 1}) {
                quality_levels.push_back(
                    {.level = level, .samples = samples, .enough = level == 1 && samples == 4});
                times.push_back({.samples = samples,
                                 .work = {triangles, 5e4},
                                 .ms = 0.5 + 1e-4 * triangles + 2e-5 * 5e4 * samples});
            }
        }
    }
    [[nodiscard]] scene::Governor governor(double deadline = deadline_ms) const {
        return {quality_levels, times, deadline};
    }
    void frame(scene::Governor& governor, MonotonicTime now, double load) const {
        const scene::QualityLevelTime& quality_level = times[governor.index()];
        governor.observe(now, quality_level.work, quality_level.ms * load);
    }
};

Nanoseconds step_of(double seconds) {
    return Nanoseconds(std::llround(seconds * 1e9));
}

/// Seconds from a load of 2.5 until the governor relieves; negative: never.
double relieved_after(double step_s) {
    const Gpu gpu;
    scene::Governor governor = gpu.governor();
    const Nanoseconds step = step_of(step_s);
    gpu.frame(governor, MonotonicTime{}, 1.0);
    for (Nanoseconds t = step; t <= std::max(Nanoseconds(std::chrono::seconds(3)), 10 * step); t += step) {
        gpu.frame(governor, MonotonicTime(t), 2.5);
        if (governor.index() != 0) {
            return to_seconds(t);
        }
    }
    return -1.0;
}

/// Time until relief with infinitely many frames: until the expected time is 90 % of the deadline, plus the
/// delay.
double exact_relief() {
    const long double share = std::log(scene::Governor::leave_share * deadline_ms / 8.5L) / std::log(2.5L);
    return static_cast<double>(-scene::FrameTimeModel::time_constant_s * std::log1p(-share)) +
           to_seconds(scene::Governor::leave_delay);
}

constexpr std::array relief_steps{1e-6, 1e-5, 1e-4, 1e-3, 1.0 / 240.0, 1.0 / 60.0, 0.05, 0.1, 1.0, 10.0};

StabilityResult relief(const StabilityOptions&) {
    double late = 0.0;
    double early = 0.0;
    for (const double step : relief_steps) {
        const double after = relieved_after(step);
        late = std::fmax(late, after < 0.0 ? 1e9 : (after - exact_relief()) / step);
        early = std::fmax(early, exact_relief() - after - 1e-9);
    }
    // One step until the request is seen, one until its delay is over, one for a step that counts as 0.1 s.
    return {{{"relief later than with endless frames, in steps", 3.0, late}, {"earlier, s", 0.0, early}}};
}

/// Constant loads over a long time. The last level may depend on the history only within the hysteresis: it
/// is not slow enough to be left for a faster one, and no better one would be entered.
StabilityResult constant_loads(const StabilityOptions&) {
    const Gpu gpu;
    double wrong = 0.0;
    double max_changes = 0.0;
    double late_changes = 0.0;
    for (const double load : sweep(0.1, 200.0, 24)) {
        for (const double step : {1e-3, 1.0 / 60.0, 0.1, 1.0, 10.0}) {
            scene::Governor governor = gpu.governor();
            std::uint64_t early = 0;
            for (int k = 0; k < 20'000; ++k) {
                gpu.frame(governor, MonotonicTime(k * step_of(step)), load);
                early = k < 1000 ? governor.switches() : early;
            }
            late_changes += static_cast<double>(governor.switches() - early);
            constexpr double hair = 1e-6;
            const std::size_t last = governor.index();
            const auto share = [&](std::size_t quality_level) {
                return gpu.times[quality_level].ms * load / deadline_ms;
            };
            wrong += last + 1 < gpu.quality_levels.size() && share(last) > scene::Governor::leave_share + hair
                         ? 1.0
                         : 0.0;
            for (std::size_t finer = 0; finer < last; ++finer) {
                wrong += share(finer) < scene::Governor::enter_share - hair ? 1.0 : 0.0;
            }
            max_changes = std::fmax(max_changes, static_cast<double>(governor.switches()));
        }
    }
    return {
        {{"ends at a level outside its hysteresis", 0.0, wrong},
         {"changes, after 1000 frames of 20000", 0.0, late_changes},
         {"changes in all, at one load", 2.0 * static_cast<double>(gpu.quality_levels.size()), max_changes}}};
}

/// Loads that alternate with every period from a microsecond to a quarter of an hour.
StabilityResult jumping_loads(const StabilityOptions&) {
    const Gpu gpu;
    double shortest_s = std::numeric_limits<double>::infinity();
    double max_per_s = 0.0;
    for (const double step : {1e-3, 1.0 / 60.0, 0.1, 1.0}) {
        for (const double period : sweep(1e-3, 1e3, 2)) {
            scene::Governor governor = gpu.governor();
            double changed = -1e9;
            std::uint64_t before = 0;
            for (int k = 0; k < 20'000; ++k) {
                const double t = k * step;
                gpu.frame(governor, MonotonicTime(k * step_of(step)),
                          std::fmod(t, period) < 0.5 * period ? 0.5 : 3.0);
                if (governor.switches() != before) {
                    shortest_s = std::fmin(shortest_s, t - changed);
                    changed = t;
                    before = governor.switches();
                }
            }
            max_per_s = std::fmax(max_per_s, static_cast<double>(before) / (20'000 * step));
        }
    }
    return {
        {{"short of a second between two changes, s", 1e-6, to_seconds(scene::Governor::dwell) - shortest_s},
         {"changes a second", 1.0, max_per_s}}};
}

/// Initial times that are wrong by a factor of up to 8 either way, at a load where only the fastest level
/// meets the deadline.
StabilityResult wrong_starts(const StabilityOptions&) {
    constexpr double load = 5.0; // 42, 32, 28; 28, 18, 12 ms
    constexpr int frames = 20'000;
    const Gpu truth;
    std::mt19937 random(1);
    double worst_share = 0.0;
    double max_changes = 0.0;
    for (int trial = 0; trial < 100; ++trial) {
        Gpu wrong;
        for (scene::QualityLevelTime& time : wrong.times) {
            time.ms *= std::exp2(
                6.0 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 3.0);
        }
        scene::Governor governor = wrong.governor();
        double late = 0.0;
        for (int k = 0; k < frames; ++k) {
            const scene::QualityLevelTime& quality_level = truth.times[governor.index()];
            late += quality_level.ms * load > deadline_ms ? 1.0 : 0.0;
            governor.observe(MonotonicTime(k * step_of(1.0 / 60.0)), quality_level.work,
                             quality_level.ms * load);
        }
        worst_share = std::fmax(worst_share, late / frames);
        max_changes = std::fmax(max_changes, static_cast<double>(governor.switches()));
    }
    return {{{"share of late frames in 333 s, worst of 100 starts", 0.2, worst_share},
             {"changes, the most", 40.0, max_changes}}};
}

/// Time that stands still, goes back or leaps; frame times that are invalid.
StabilityResult odd_steps(const StabilityOptions&) {
    const Gpu gpu;
    double wrong = 0.0;
    scene::Governor governor = gpu.governor();
    MonotonicTime now = from_microseconds(1'000'000'000);
    for (int k = 0; k < 10'000; ++k) { // time stands still: no decision
        gpu.frame(governor, now, 3.0);
    }
    wrong += governor.switches() > 1 ? 1.0 : 0.0;
    const std::uint64_t still = governor.switches();
    for (int k = 0; k < 10'000; ++k) { // backwards
        gpu.frame(governor, now -= std::chrono::milliseconds(16), 3.0);
    }
    wrong += governor.switches() != still ? 1.0 : 0.0;
    for (const double ms : {0.0, -1.0, 1e9, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()}) {
        governor.observe(now += std::chrono::seconds(10), {4e4, 5e4}, ms);
    }
    wrong += governor.ignored() == 5 && governor.switches() == still ? 0.0 : 1.0;
    now = from_microseconds(2'000'000'000);
    for (int k = 0; k < 2000; ++k) { // and then it works normally
        gpu.frame(governor, now += std::chrono::milliseconds(16), 1.0);
    }
    wrong += governor.index() == 0 && std::isfinite(governor.expected_ms()) ? 0.0 : 1.0;
    return {{{"decisions without time, of garbage, or none afterwards", 0.0, wrong}}};
}

/// Deadlines that every level meets, and deadlines that none meets.
StabilityResult deadlines(const StabilityOptions&) {
    const Gpu gpu;
    double wrong = 0.0;
    for (const double deadline : {1e-9, 1e-3, 1.0, 1e3, 1e9}) {
        scene::Governor governor = gpu.governor(deadline);
        for (int k = 0; k < 2000; ++k) {
            gpu.frame(governor, MonotonicTime(k * std::chrono::milliseconds(16)), 1.0);
        }
        wrong += governor.index() == (deadline < 2.0 ? gpu.quality_levels.size() - 1 : 0) &&
                         governor.switches() == 0
                     ? 0
                     : 1;
    }
    return {{{"of 1e-9 to 1e9 ms: not the quickest, or not the best, or a change", 0.0, wrong}}};
}

} // namespace

std::vector<StepError> governor_step_errors() {
    std::vector<StepError> errors;
    errors.reserve(relief_steps.size());
    for (const double step : relief_steps) {
        errors.push_back({"late relief, s", step, std::fmax(0.0, relieved_after(step) - exact_relief())});
    }
    return errors;
}

std::vector<StabilityCase> governor_cases() {
    const std::string theme = "governor";
    return {{theme, "relief, steps 1 us to 10 s", FloatingPoint::Strict, relief},
            {theme, "constant loads 0.1 to 200, steps 1 ms to 10 s", FloatingPoint::Strict, constant_loads},
            {theme, "loads that jump every 1 ms to 1000 s", FloatingPoint::Strict, jumping_loads},
            {theme, "starts that measured wrongly", FloatingPoint::Strict, wrong_starts},
            {theme, "time that stands still, goes back, leaps; garbage", FloatingPoint::Free, odd_steps},
            {theme, "deadlines of 1e-9 to 1e9 ms", FloatingPoint::Strict, deadlines}};
}

} // namespace frustumscreen::bench
