/// The results of `frustumscreen-bench latency` as text and CSV.
///
/// Units    mm, ms.
/// Threads  pure; any.
#pragma once

#include "app/bench/latency/latency.h"
#include "app/bench/measures/verdicts.h"

#include <span>
#include <string>
#include <vector>

namespace frustumscreen::bench {

/// Targets for a 60 Hz display, 18 ms + 17 ms of latency, 0.3 mm and 0.15 degrees of noise. They judge the
/// exhibit's filter as shown; the stop is judged by the 95th percentile of the runs.
[[nodiscard]] std::vector<LimitVerdict> judge(const TrackerResult& result, const LatencyOptions& options);

[[nodiscard]] std::string latency_table(const TrackerResult& result, const LatencyOptions& options);
[[nodiscard]] std::string recordings_table(std::span<const RecordingResult> recordings);
[[nodiscard]] std::string latency_csv(std::span<const TrackerResult> results,
                                      std::span<const RecordingResult> recordings);

} // namespace frustumscreen::bench
