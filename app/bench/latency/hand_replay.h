/// Recordings of hands, replayed faster: how far the picture slips on a prop that is held, and how far it passes the
/// places at which the hand turns back. The same recordings, flattened onto the table, give the slip on a sliding
/// prop.
///
/// Motion   the recording at 1, 2 and 4 times its speed, sampled at the tracker's own rate, with its noise and latency.
///          The truth is the recording itself at the time of light.
/// Units    mm.
/// Threads  pure; any. One seed gives the same numbers with the same C++ library.
#pragma once

#include "app/bench/latency/latency.h"

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

/// How far the picture passes the places where a coordinate of the prop turns back, after at least 10 mm each way.
[[nodiscard]] Slip overshoot_at_turns(std::span<const LitPicture> pictures);

struct ReplayResult {
    std::string tracker;
    std::string recording;
    std::string filter_name;
    double times = 1.0;    ///< the recording's speed
    bool on_table = false; ///< flattened
    Slip slip;
    Slip overshoot;
};

/// The filter for the table alone, the hand's alone, constant velocity, the exhibit's as shown; and the best weights
/// (best_weights.h).
[[nodiscard]] std::vector<ReplayResult> replay(const PoseRecording& recording, const TrackedBy& tracker,
                                               const LatencyOptions& options);

[[nodiscard]] std::string replay_table(std::span<const ReplayResult> results);
[[nodiscard]] std::string replay_csv(std::span<const ReplayResult> results);

} // namespace frustumscreen::bench
