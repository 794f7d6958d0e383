/// The results of `frustumscreen-bench ladder` as text and CSV.
///
/// Threads  pure; any.
#pragma once

#include "tests/simulators/museum/museum.h"

#include <span>
#include <string>

namespace frustumscreen::simulators {

/// Policies next to each other.
[[nodiscard]] std::string museum_table(std::span<const MuseumRun> runs,
                                       std::span<const FaultEvent> fault_events);
/// One row per policy.
[[nodiscard]] std::string museum_csv(std::span<const MuseumRun> runs, int days);
/// Number of dark periods per year longer than a length: rows per policy, ascending in length.
[[nodiscard]] std::string dark_times_csv(std::span<const MuseumRun> runs, int days);
/// One row per policy and fault: how often it came, and the longest dark period that began with it.
[[nodiscard]] std::string faults_csv(std::span<const MuseumRun> runs,
                                     std::span<const FaultEvent> fault_events);
[[nodiscard]] std::size_t false_alarms(const MuseumRun& run);
[[nodiscard]] std::size_t count_of(const MuseumRun& run, watch::Step step);

} // namespace frustumscreen::simulators
