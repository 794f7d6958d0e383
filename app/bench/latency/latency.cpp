#include "app/bench/latency/latency.h"

#include "app/bench/latency/one_euro.h"
#include "app/tracking/held_filter.h"
#include "app/tracking/pose_estimator.h"
#include "app/tracking/shown_pose.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace frustumscreen::bench {

namespace {

constexpr double clock_drift = 1.0003;
constexpr double warm_up_s = 1.0;
constexpr int stops = 200;

MonotonicTime time_at(double t_s) {
    // Far from zero, like a real clock.
    return MonotonicTime(std::chrono::hours(1) + Nanoseconds(std::llround(t_s * 1e9)));
}

class Noise {
public:
    Noise(const tracking::PoseNoise& sd, std::uint64_t seed) : sd_(sd), random_(seed) {}
    geometry::RigidTransform on(const geometry::RigidTransform& pose) {
        return tracking::moved(pose, {sd_.place_m * vector(), sd_.turn_rad * vector()});
    }

private:
    glm::dvec3 vector() {
        const double x = normal_(random_);
        const double y = normal_(random_);
        return {x, y, normal_(random_)};
    }
    tracking::PoseNoise sd_;
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
};

std::vector<LitPicture> play(std::span<const RecordedPose> samples, const HandMotion& truth, double length_s,
                             const TrackedBy& tracker, const LatencySetting& setting,
                             const ComparedFilter& compared) {
    tracking::PoseEstimatorOptions options;
    options.predicts = compared.predicts;
    // Allow the whole latency under test plus one sample, regardless of the exhibit's own limit.
    options.predicted_for =
        std::max(options.predicted_for,
                 Nanoseconds(std::llround(1e6 * (tracker.latency_ms + setting.display_latency_ms) +
                                          2e9 / tracker.rate_hz)));
    tracking::PoseEstimator estimator(compared.filter(tracker.noise), options);
    tracking::ShownPose shown({.lever_m = setting.lever_m});
    std::vector<LitPicture> pictures;
    std::size_t next = 0;
    for (int frame = 0;; ++frame) {
        const double now_s = frame / setting.display_hz;
        const double lit_s = now_s + 1e-3 * setting.display_latency_ms;
        if (lit_s >= length_s) {
            return pictures;
        }
        for (; next < samples.size() && samples[next].t_s + 1e-3 * tracker.latency_ms <= now_s; ++next) {
            estimator.take(time_at(samples[next].t_s), samples[next].pose);
        }
        const tracking::PoseEstimate estimate = estimator.at(time_at(lit_s));
        if (estimate.reinitialisations > 0) {
            pictures.push_back({lit_s,
                                compared.shown ? shown.follow(estimate, time_at(lit_s)) : estimate.pose,
                                truth(lit_s)});
        }
    }
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) /
           static_cast<double>(std::max<std::size_t>(values.size(), 1));
}

double rms(const std::vector<double>& values) {
    return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
                     static_cast<double>(std::max<std::size_t>(values.size(), 1)));
}

} // namespace

std::vector<ComparedFilter> compared_filters() {
    const auto none = [](const tracking::PoseNoise&) { return std::make_unique<NoFilter>(); };
    const auto one_euro = [](const tracking::PoseNoise&) { return std::make_unique<OneEuroFilter>(); };
    const auto glide = [](const tracking::PoseNoise& noise) {
        return std::make_unique<tracking::MotionFilter>(tracking::constant_velocity_filter(noise));
    };
    const auto exhibit = [](const tracking::PoseNoise& noise) {
        return std::make_unique<tracking::HeldFilter>(noise);
    };
    return {{"no filter", none, false, false},
            {"One Euro", one_euro, false, false},
            {"One Euro, predicted", one_euro, true, false},
            {"constant velocity", glide, false, false},
            {"constant velocity, predicted", glide, true, false},
            {"exhibit", exhibit, false, false},
            {"exhibit, predicted", exhibit, true, false},
            {"exhibit, as shown", exhibit, true, true}};
}

std::vector<RecordedPose> tracked_samples(const HandMotion& motion, double length_s, const TrackedBy& tracker,
                                          std::uint64_t seed) {
    Noise noise(tracker.noise, seed);
    std::vector<RecordedPose> samples;
    const double step_s = 1.0 / (tracker.rate_hz * clock_drift);
    const auto count = static_cast<std::size_t>(std::ceil(length_s / step_s));
    for (std::size_t k = 0; k < count; ++k) {
        const double t_s = step_s * static_cast<double>(k);
        samples.push_back({t_s, noise.on(motion(t_s))});
    }
    return samples;
}

std::vector<LitPicture> lit_pictures(const HandMotion& motion, double length_s, const TrackedBy& tracker,
                                     const LatencySetting& setting, const ComparedFilter& compared,
                                     std::uint64_t seed) {
    return play(tracked_samples(motion, length_s, tracker, seed), motion, length_s, tracker, setting,
                compared);
}

std::vector<LitPicture> lit_pictures(std::span<const RecordedPose> samples, const TrackedBy& tracker,
                                     const LatencySetting& setting, const ComparedFilter& compared,
                                     std::uint64_t seed) {
    Noise noise(tracker.noise, seed);
    std::vector<RecordedPose> noisy(samples.begin(), samples.end());
    for (RecordedPose& sample : noisy) {
        sample.pose = noise.on(sample.pose);
    }
    return play(noisy, recorded(samples), samples.back().t_s, tracker, setting, compared);
}

Slip slip_of(std::span<const LitPicture> pictures, double lever_m) {
    std::vector<double> slips;
    for (const LitPicture& picture : pictures) {
        if (picture.lit_s >= warm_up_s) {
            slips.push_back(1e3 *
                            tracking::slip_m(tracking::step_between(picture.truth, picture.drawn), lever_m));
        }
    }
    return {mean(slips), quantile(slips, 0.95), rms(slips)};
}

Slip tremble_of(std::span<const LitPicture> pictures, double lever_m) {
    std::vector<double> steps;
    for (std::size_t k = 1; k < pictures.size(); ++k) {
        if (pictures[k].lit_s >= warm_up_s) {
            const tracking::PoseStep before =
                tracking::step_between(pictures[k - 1].truth, pictures[k - 1].drawn);
            const tracking::PoseStep now = tracking::step_between(pictures[k].truth, pictures[k].drawn);
            steps.push_back(
                1e3 *
                tracking::slip_m({now.shift_m - before.shift_m, now.turn_rad - before.turn_rad}, lever_m));
        }
    }
    return {mean(steps), quantile(steps, 0.95), rms(steps)};
}

Overshoot overshoot_of(const TrackedBy& tracker, const LatencySetting& setting,
                       const ComparedFilter& compared, std::uint64_t seed) {
    std::vector<double> past;
    std::vector<double> ahead;
    for (int k = 0; k < stops; ++k) {
        // Braking begins at a different phase of pictures and samples in each run.
        const double brake_at_s = 1.0 + static_cast<double>(k) / stops / 3.0;
        const HandMotion motion = stop(stop_speed_m_s, stop_braking_m_s2, brake_at_s);
        const double stand_m = motion(brake_at_s + 1.0).translation.x;
        past.push_back(0.0);
        ahead.push_back(0.0);
        for (const LitPicture& picture : lit_pictures(motion, brake_at_s + 1.0, tracker, setting, compared,
                                                      seed + static_cast<std::uint64_t>(k))) {
            const double drawn_m = picture.drawn.translation.x;
            if (picture.lit_s >= brake_at_s) {
                past.back() = std::fmax(past.back(), 1e3 * (drawn_m - stand_m));
                ahead.back() = std::fmax(ahead.back(), 1e3 * (drawn_m - picture.truth.translation.x));
            }
        }
    }
    return {.mean = mean(past),
            .p95 = quantile(past, 0.95),
            .worst = quantile(past, 1.0),
            .rms = rms(past),
            .ahead_mean = mean(ahead),
            .ahead_p95 = quantile(ahead, 0.95),
            .ahead_rms = rms(ahead)};
}

TrackerResult measure_tracker(const TrackedBy& tracker, const LatencyOptions& options) {
    const LatencySetting& setting = options.setting;
    TrackerResult result{tracker, tracker.latency_ms + setting.display_latency_ms, {}};
    for (const ComparedFilter& compared : compared_filters()) {
        FilterResult one{.name = compared.name,
                         .predicts = compared.predicts,
                         .strokes = {},
                         .trembles = {},
                         .rest = {},
                         .stop = {},
                         .latencies = {}};
        const auto slip = [&](const HandMotion& motion, const LatencySetting& with) {
            return slip_of(lit_pictures(motion, options.length_s, tracker, with, compared, options.seed),
                           setting.lever_m);
        };
        for (const double speed_m_s : options.speeds_m_s) {
            one.strokes.push_back(
                {speed_m_s, slip(strokes(speed_m_s, options.length_s, options.seed), setting)});
        }
        for (const double speed_m_s : options.slides_m_s) {
            const HandMotion slide =
                stop(speed_m_s, stop_braking_m_s2, options.length_s); // no braking before the end
            one.trembles.push_back({speed_m_s, tremble_of(lit_pictures(slide, options.length_s, tracker,
                                                                       setting, compared, options.seed),
                                                          setting.lever_m)});
        }
        one.rest = slip(rest(), setting);
        one.stop = overshoot_of(tracker, setting, compared, options.seed);
        const HandMotion motion = strokes(latency_speed_m_s, options.length_s, options.seed);
        for (int tens = 0; tens <= 8; ++tens) {
            const double display_ms = 10.0 * tens;
            LatencySetting later = setting;
            later.display_latency_ms = display_ms;
            one.latencies.push_back({tracker.latency_ms + display_ms, slip(motion, later)});
        }
        result.filters.push_back(std::move(one));
    }
    return result;
}

RecordingResult measure_recording(const PoseRecording& recording, const LatencyOptions& options) {
    TrackedBy tracker{.name = recording.name, .rate_hz = 60.0, .latency_ms = 18.0, .noise = {}};
    RecordingResult result{recording.name, tracker.latency_ms + options.setting.display_latency_ms, {}};
    if (recording.poses.size() > 1) {
        tracker.rate_hz = static_cast<double>(recording.poses.size() - 1) /
                          (recording.poses.back().t_s - recording.poses.front().t_s);
    }
    if (recording.noisy) {
        tracker.noise = {0.0, 0.0};
    }
    for (ComparedFilter compared : compared_filters()) {
        // The filters expect their default noise, even if the recording has its own.
        compared.filter = [make = compared.filter](const tracking::PoseNoise&) {
            return make(tracking::PoseNoise{});
        };
        result.slips.emplace_back(
            compared.name,
            slip_of(lit_pictures(recording.poses, tracker, options.setting, compared, options.seed),
                    options.setting.lever_m));
    }
    return result;
}

} // namespace frustumscreen::bench
