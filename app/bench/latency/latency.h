/// How far the picture slips on the prop because tracker and projector take time. Input is simulated motion
/// or a recording; it passes through a tracker of a given rate, latency and noise and a pose estimator, up to
/// the time at which the picture is lit.
///
/// Slip     at the prop: distance of the origins plus half the prop's height times the angle, between the
///          pose that was drawn and the true pose when the picture is lit.
/// Time     simulated; the tracker's clock runs 0.03 % faster than its nominal rate, so samples occur at
///          every phase between the pictures.
/// Threads  pure; any. One seed gives the same numbers with the same C++ library.
#pragma once

#include "app/bench/latency/hand_motion.h"
#include "app/tracking/motion_filter.h"
#include "app/tracking/pose_filter.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace frustumscreen::bench {

struct TrackedBy {
    std::string name;
    double rate_hz = 60.0;
    double latency_ms = 18.0;  ///< from a pose until the exhibit receives its sample
    tracking::PoseNoise noise; ///< per axis, RMS
};

struct LatencySetting {
    double display_hz = 60.0;
    double display_latency_ms = 17.0; ///< from the poll until the picture is lit
    double lever_m = 0.06;            ///< half the prop's height
};

/// A filter to compare.
struct ComparedFilter {
    std::string name;
    std::function<std::unique_ptr<tracking::PoseFilter>(const tracking::PoseNoise&)> filter;
    bool predicts = true;
    bool shown = false; ///< through ShownPose, as in the exhibit
};
/// No filter; One Euro, constant velocity and the exhibit's filter, each without and with prediction; and the
/// exhibit's filter as shown.
[[nodiscard]] std::vector<ComparedFilter> compared_filters();

/// One picture of a run.
struct LitPicture {
    double lit_s = 0.0;
    geometry::RigidTransform drawn;
    geometry::RigidTransform truth;
};

/// The tracker's samples of a motion.
[[nodiscard]] std::vector<RecordedPose> tracked_samples(const HandMotion& motion, double length_s,
                                                        const TrackedBy& tracker, std::uint64_t seed);

[[nodiscard]] std::vector<LitPicture> lit_pictures(const HandMotion& motion, double length_s,
                                                   const TrackedBy& tracker, const LatencySetting& setting,
                                                   const ComparedFilter& compared, std::uint64_t seed);
/// Like the overload above, for recorded samples; adds noise if `tracker.noise` is not zero. The truth is
/// interpolated between the samples.
[[nodiscard]] std::vector<LitPicture> lit_pictures(std::span<const RecordedPose> samples,
                                                   const TrackedBy& tracker, const LatencySetting& setting,
                                                   const ComparedFilter& compared, std::uint64_t seed);

inline constexpr double stop_speed_m_s = 0.5;
inline constexpr double stop_braking_m_s2 = 5.0;
inline constexpr double latency_speed_m_s = 0.25; ///< of the strokes that vary the latency

/// Slip in mm, over the pictures after the first second.
struct Slip {
    double mean = 0.0;
    double p95 = 0.0;
    double rms = 0.0;
};
[[nodiscard]] Slip slip_of(std::span<const LitPicture> pictures, double lever_m);

/// How much the picture trembles on a prop that slides steadily: from one picture to the next, how far the
/// picture moves beyond the prop's own movement, at the prop, in mm, after the first second.
[[nodiscard]] Slip tremble_of(std::span<const LitPicture> pictures, double lever_m);

/// A stop along X: how far the picture passes the place where the prop stops, and how far it runs ahead of
/// the prop before that. Each run counts with its largest value, in mm.
struct Overshoot {
    double mean = 0.0;
    double p95 = 0.0; ///< over the runs
    double worst = 0.0;
    double rms = 0.0;
    double ahead_mean = 0.0; ///< ahead of the prop, from the start of braking
    double ahead_p95 = 0.0;
    double ahead_rms = 0.0;
};
[[nodiscard]] Overshoot overshoot_of(const TrackedBy& tracker, const LatencySetting& setting,
                                     const ComparedFilter& compared, std::uint64_t seed);

struct SpeedSlip {
    double speed_m_s = 0.0;
    Slip slip;
};
struct LatencySlip {
    double total_ms = 0.0; ///< tracker and display
    Slip slip;             ///< strokes at 0.25 m/s
};
struct FilterResult {
    std::string name;
    bool predicts = false;
    std::vector<SpeedSlip> strokes;
    std::vector<SpeedSlip> trembles; ///< steady slides
    Slip rest;
    Overshoot stop;
    std::vector<LatencySlip> latencies;
};
struct TrackerResult {
    TrackedBy tracker;
    double total_ms = 0.0; ///< tracker and display
    std::vector<FilterResult> filters;
};

struct LatencyOptions {
    LatencySetting setting;
    std::vector<double> speeds_m_s = {0.05, 0.1, 0.25, 0.5};
    std::vector<double> slides_m_s = {0.002, 0.005, 0.015, 0.05, 0.15};
    double length_s = 60.0;
    std::uint64_t seed = 1;
};
[[nodiscard]] TrackerResult measure_tracker(const TrackedBy& tracker, const LatencyOptions& options);

/// A recording to replay.
struct PoseRecording {
    std::string name;
    std::vector<RecordedPose> poses;
    bool noisy = true; ///< false: motion capture; a tracker's noise is added
};
struct RecordingResult {
    std::string name;
    double total_ms = 0.0;
    std::vector<std::pair<std::string, Slip>> slips; ///< by filter
};
[[nodiscard]] RecordingResult measure_recording(const PoseRecording& recording,
                                                const LatencyOptions& options);

} // namespace frustumscreen::bench
