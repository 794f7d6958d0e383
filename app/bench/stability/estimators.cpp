// The pose estimate over rates, outliers and months of uptime, and the display latency: values driven by a
// device's clock.

#include "app/bench/stability/sweep.h"
#include "app/bench/stability/themes.h"
#include "app/tracking/live_tracked_state.h"
#include "app/tracking/motion_filter.h"
#include "app/tracking/pose_estimator.h"
#include "app/tracking/pose_math.h"
#include "firmware_host/tracker/sequence_checker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace frustumscreen::bench {

namespace {

constexpr double lever_m = 0.06;                         ///< half the prop's height
constexpr std::array rates_hz{1000, 240, 60, 30, 10, 5}; ///< a slower tracker restarts the estimator with
                                                         ///< each sample

tracking::PoseEstimator exhibit_estimator() {
    return tracking::PoseEstimator(std::make_unique<tracking::MotionFilter>(tracking::exhibit_filter()));
}

Nanoseconds seconds(double value) {
    return Nanoseconds(std::llround(value * 1e9));
}

/// A hand that slides the prop: 0.25 m/s and 1 rad/s.
geometry::RigidTransform sliding(double t_s) {
    const double angle = 0.5 * t_s;
    return {glm::dquat(std::cos(angle), 0.0, 0.0, std::sin(angle)), {0.15 * t_s, -0.2 * t_s, 0.0}};
}

class Noise {
public:
    [[nodiscard]] geometry::RigidTransform on(const geometry::RigidTransform& pose) {
        const tracking::PoseNoise noise;
        const auto vector = [this](double sigma) {
            return sigma * glm::dvec3(n_(random_), n_(random_), n_(random_));
        };
        const glm::dvec3 turn = vector(noise.turn_rad);
        return {glm::normalize(tracking::rotation_of(turn) * pose.rotation),
                pose.translation + vector(noise.place_m)};
    }

private:
    std::mt19937_64 random_{3};
    std::normal_distribution<double> n_;
};

double off_mm(const geometry::RigidTransform& a, const geometry::RigidTransform& b) {
    return 1e3 * tracking::slip_m(tracking::step_between(a, b), lever_m);
}

/// Without noise: a steady slide, predicted 40 ms ahead after the first second.
StabilityResult steady_slide(const StabilityOptions&) {
    constexpr double ahead_s = 0.04;
    double worst = 0.0;
    for (const int rate : rates_hz) {
        tracking::PoseEstimator estimator = exhibit_estimator();
        for (int k = 0; k < 3 * rate; ++k) {
            const double t = static_cast<double>(k) / rate;
            estimator.take(MonotonicTime(seconds(t)), sliding(t));
            if (t > 1.0) {
                const tracking::PoseEstimate said = estimator.at(MonotonicTime(seconds(t + ahead_s)));
                worst = std::fmax(worst, off_mm(said.pose, sliding(t + ahead_s)));
            }
        }
    }
    return {{{"5 Hz to 1 kHz, 40 ms ahead of a slide of 250 mm/s, mm", 5.0, worst}}};
}

/// A prop at rest under the tracker's noise: the output must have less noise than the input.
StabilityResult rest_under_noise(const StabilityOptions&) {
    double more = 0.0;
    for (const int rate : rates_hz) {
        tracking::PoseEstimator estimator = exhibit_estimator();
        Noise noise;
        double in = 0.0;
        double out = 0.0;
        for (int k = 0; k < 5000; ++k) {
            const MonotonicTime now(seconds(static_cast<double>(k) / rate));
            const geometry::RigidTransform measured = noise.on({});
            estimator.take(now, measured);
            in += std::pow(off_mm(measured, {}), 2);
            out += std::pow(off_mm(estimator.at(now + std::chrono::milliseconds(40)).pose, {}), 2);
        }
        more = std::fmax(more, std::sqrt(out / in));
    }
    return {{{"5 Hz to 1 kHz, 40 ms ahead: RMS said / RMS measured", 0.5, more}}};
}

/// Every tenth sample is an outlier. It must not change the estimate from the other nine.
StabilityResult outliers(const StabilityOptions&) {
    double worst = 0.0;
    double taken = 0.0;
    for (const int rate : {1000, 240, 60}) {
        for (const double away_m : {0.1, 1.0, 1e3, 1e12}) {
            tracking::PoseEstimator estimator = exhibit_estimator();
            for (int k = 0; k < 5 * rate; ++k) {
                const MonotonicTime now(seconds(static_cast<double>(k) / rate));
                const bool wrong = k % 10 == 9;
                const tracking::Taken result =
                    estimator.take(now, {glm::dquat(1.0, 0.0, 0.0, 0.0), {wrong ? away_m : 0.0, 0.0, 0.0}});
                taken += wrong && result != tracking::Taken::Outlier ? 1.0 : 0.0;
                worst = std::fmax(worst, off_mm(estimator.at(now + std::chrono::milliseconds(40)).pose, {}));
            }
        }
    }
    return {{{"each tenth sample 0.1 m to 1e12 m away: taken", 0.0, taken},
             {"what they move the answer by, mm", 0.0, worst}}};
}

/// Identical samples at the start and after years without a break: only differences of times count.
StabilityResult uptime(const StabilityOptions&) {
    constexpr std::array years{0.0, 0.5, 10.0, 100.0};
    double different = 0.0;
    std::vector<geometry::RigidTransform> first;
    for (const double year : years) {
        const MonotonicTime start(seconds(year * 365.25 * 86'400.0));
        tracking::PoseEstimator estimator = exhibit_estimator();
        Noise noise;
        for (std::size_t k = 0; k < 600; ++k) {
            const auto t = Nanoseconds(16'666'667 * static_cast<std::int64_t>(k));
            estimator.take(start + t, noise.on(sliding(to_seconds(t))));
            const geometry::RigidTransform said =
                estimator.at(start + t + std::chrono::milliseconds(25)).pose;
            if (first.size() <= k) {
                first.push_back(said);
            }
            different +=
                said.translation == first[k].translation && said.rotation == first[k].rotation ? 0.0 : 1.0;
        }
    }
    return {{{"0 to 100 years after the start: answers that differ in a bit", 0.0, different}}};
}

/// Slow trackers at rest, queried at 60 Hz: whether the pose of a standing prop is known.
StabilityResult slow_trackers(const StabilityOptions&) {
    double stale = 0.0;
    double held_s = 0.0;
    for (const double step_s : {0.1, 0.5, 1.0, 1.9}) {
        tracking::PoseEstimator estimator = exhibit_estimator();
        MonotonicTime now{};
        for (int k = 0; k < 40; ++k) {
            now = MonotonicTime(seconds(k * step_s));
            estimator.take(now, {});
            for (double t = 0.0; k > 2 && t < step_s + 0.05; t += 1.0 / 60.0) {
                stale += estimator.at(now + seconds(t)).status == tracking::PoseStatus::Stale ? 1.0 : 0.0;
            }
        }
        double t = 0.0;
        while (t < 60.0 && estimator.at(now + seconds(t)).status != tracking::PoseStatus::Stale) {
            t += 0.01;
        }
        held_s = std::fmax(held_s, t);
    }
    return {{{"0.5 to 10 Hz: frames without a pose, though the tracker tells of it", 0.0, stale},
             {"held after the last sample, s", 5.0, held_s}}};
}

/// Frames of 1 us to 10 s: the delay follows a jump of the flips by the closed form.
StabilityResult light_delay(const StabilityOptions&) {
    constexpr double from_s = 0.008;
    constexpr double to_s = 0.033;
    double off_s = 0.0;
    for (const double step_s : sweep(1e-6, 10.0, 4)) {
        tracking::LightDelay delay(Nanoseconds(0));
        const Nanoseconds step = seconds(step_s);
        MonotonicTime now{};
        delay.flipped(now, now + seconds(from_s));
        for (int k = 1; k <= 1000; ++k) {
            now += step;
            delay.flipped(now, now + seconds(to_s));
            const long double gone = to_seconds(k * step);
            const auto exact = static_cast<double>(
                to_s + (from_s - to_s) *
                           std::exp(-gone / static_cast<long double>(tracking::LightDelay::time_constant_s)));
            off_s = std::fmax(off_s, std::abs(to_seconds(delay.from_now()) - exact));
        }
    }
    return {{{"flips that jump, steps 1 us to 10 s: off the exact response, s", 1e-9, off_s}}};
}

/// The result of a device's stream of frames: its counts, and the pose at each query.
struct Followed {
    double refused = 0.0; ///< lost, duplicate, late or invalid frames, and restarts of the clock
    std::vector<tracker::PoseSample> samples;
    std::vector<geometry::RigidTransform> poses;
};
/// Twenty seconds of a slide at 240 Hz, with noise; frames arrive up to a few milliseconds late.
Followed follow(std::uint32_t first_counter, std::uint32_t first_tick) {
    constexpr int rate_hz = 240;
    tracker::SequenceChecker intake(1e9 / rate_hz);
    tracking::PoseEstimator estimator = exhibit_estimator();
    Noise noise;
    std::mt19937_64 random(5);
    std::exponential_distribution<double> late_s(1.0 / 0.0003);
    Followed followed;
    for (std::uint32_t k = 0; k < 20 * rate_hz; ++k) {
        const double t = static_cast<double>(k) / rate_hz;
        const geometry::RigidTransform pose = noise.on(sliding(t));
        tracker::DeviceFrame frame;
        frame.counter = first_counter + k;
        frame.tick = first_tick + k;
        frame.count = 1;
        frame.sensors[0] = {.sensor = tracker::prop_station,
                            .position_m = pose.translation,
                            .rotation = pose.rotation,
                            .distortion = 0,
                            .usable = true,
                            .present = true};
        const MonotonicTime arrival{seconds(1.0 + t + late_s(random))};
        const std::size_t before = followed.samples.size();
        intake.take(frame, arrival, followed.samples);
        for (std::size_t j = before; j < followed.samples.size(); ++j) {
            const tracker::PoseSample& sample = followed.samples[j];
            estimator.take(sample.time, {sample.rotation, sample.position_m});
        }
        followed.poses.push_back(estimator.at(arrival + seconds(0.04)).pose);
    }
    const tracker::TrackerCounts counts = intake.counts();
    followed.refused = static_cast<double>(counts.lost + counts.duplicated + counts.reordered +
                                           counts.implausible + counts.clock_restarts);
    return followed;
}

/// 32-bit counters wrap after more than a year: the results must not change at the wrap, nor where the sign
/// bit changes.
StabilityResult wrapping_counters(const StabilityOptions&) {
    constexpr std::uint32_t before_wrap = 0xFFFFFF00U; // 256 frames
    constexpr std::uint32_t before_sign = 0x7FFFFF00U;
    const Followed plain = follow(0, 0);
    double other = 0.0;
    double refused = plain.refused;
    for (const auto& [counter, tick] : {std::pair(before_wrap, before_wrap),
                                        {before_wrap, 0U},
                                        {0U, before_wrap},
                                        {before_sign, before_sign}}) {
        const Followed wraps = follow(counter, tick);
        refused += wraps.refused;
        other += wraps.samples.size() == plain.samples.size() ? 0.0 : 1.0;
        for (std::size_t k = 0; k < std::min(wraps.samples.size(), plain.samples.size()); ++k) {
            other += wraps.samples[k].time == plain.samples[k].time ? 0.0 : 1.0;
        }
        for (std::size_t k = 0; k < plain.poses.size(); ++k) {
            other += wraps.poses[k].translation == plain.poses[k].translation &&
                             wraps.poses[k].rotation == plain.poses[k].rotation
                         ? 0.0
                         : 1.0;
        }
    }
    return {{{"counter, tick or both from 0xFFFFFF00 and 0x7FFFFF00: times and poses other than from 0", 0.0,
              other},
             {"frames refused, and restarts of the clock", 0.0, refused}}};
}

} // namespace

std::vector<StabilityCase> estimator_cases() {
    const std::string theme = "estimate of a pose";
    return {{theme, "a steady slide", FloatingPoint::Strict, steady_slide},
            {theme, "rest under noise", FloatingPoint::Strict, rest_under_noise},
            {theme, "outliers", FloatingPoint::Strict, outliers},
            {theme, "months of uptime", FloatingPoint::Strict, uptime},
            {theme, "counters that wrap", FloatingPoint::Strict, wrapping_counters},
            {theme, "slow trackers", FloatingPoint::Strict, slow_trackers},
            {"display's delay", "flips that jump", FloatingPoint::Strict, light_delay}};
}

} // namespace frustumscreen::bench
