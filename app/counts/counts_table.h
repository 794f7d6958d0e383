/// The numbers of visits for a curator: summed, as a table for a spreadsheet, as JSON.
///
/// Threads  pure; any.
#pragma once

#include "app/counts/counts_folder.h"

#include <array>
#include <string>
#include <vector>

namespace frustumscreen::counts {

struct NamedTally {
    std::string name;
    Tally tally;
};

struct CountsSummary {
    std::chrono::sys_days first{}, last{}; ///< that have numbers
    std::size_t days = 0;                  ///< that have numbers; 0: none
    Tally all;
    std::array<Tally, 24> hours{};
    std::array<Tally, 7> weekdays{};              ///< from Monday
    std::array<std::size_t, 7> days_of_weekday{}; ///< that have numbers
    std::vector<NamedTally> artifacts, languages; ///< the longest shown first
};
/// Uses only the days with a date; counts taken while the clock was wrong have none.
[[nodiscard]] CountsSummary summary_of(const std::vector<DayCounts>& days);

/// A text of some lines.
[[nodiscard]] std::string counts_text(const ReadCounts& counts);
/// CSV: day,kind,name,visits,minutes. `kind`: hour, artifact or language; `name`: 0 to 23, its title, its tag.
/// `day` is empty for counts taken while the clock was wrong.
[[nodiscard]] std::string counts_csv(const ReadCounts& counts);
[[nodiscard]] std::string counts_json(const ReadCounts& counts);

[[nodiscard]] inline double minutes_of(const Tally& tally) {
    return static_cast<double>(tally.ms) / 60'000.0;
}
/// Rounded to the nearest.
[[nodiscard]] inline std::uint64_t whole_minutes_of(const Tally& tally) {
    return (tally.ms + 30'000) / 60'000;
}
/// "12 345"
[[nodiscard]] std::string grouped(std::uint64_t number);

} // namespace frustumscreen::counts
