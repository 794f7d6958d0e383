/// The results of frustumscreen-bench ladder as words and CSV.
///
/// Threads  pure; any.
#pragma once

#include "tests/simulators/museum/museum.h"

#include <span>
#include <string>

namespace frustumscreen {

/// Policies side by side.
[[nodiscard]] std::string museum_table(std::span<const MuseumRun> runs, std::span<const Attack> attacks);
/// A row for each policy.
[[nodiscard]] std::string museum_csv(std::span<const MuseumRun> runs, int days);
/// How many dark times a year are longer than so many seconds: rows for each policy, ascending in length.
[[nodiscard]] std::string dark_times_csv(std::span<const MuseumRun> runs, int days);
/// A row for each policy and ailment: how often it came, and the longest time that the table was dark then.
[[nodiscard]] std::string ailments_csv(std::span<const MuseumRun> runs, std::span<const Attack> attacks);
[[nodiscard]] std::size_t false_alarms(const MuseumRun& run);
[[nodiscard]] std::size_t count_of(const MuseumRun& run, Step step);

} // namespace frustumscreen
