/// The folder of the visits' numbers: a file for each day, `2026-11-27.json`, and `undated.json` for times with a
/// wrong clock.
///
/// Power    a file is replaced by one rename, after its bytes are on the disk: a power cut leaves the old numbers
///          or the new ones.
/// Damage   a file that cannot be read is renamed to `....bad`, and never overwritten.
/// Kept     the latest `max_days` days that have a file.
/// Threads  any, never in a frame.
/// Errors   one sentence.
#pragma once

#include "app/counts/day_counts.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::counts {

inline constexpr std::size_t max_days = 400;

[[nodiscard]] std::filesystem::path file_of_day(const std::filesystem::path& folder,
                                                std::optional<std::chrono::sys_days> day);

struct OpenedDay {
    DayCounts counts;    ///< empty if the file is missing or damaged
    std::string trouble; ///< a sentence: a damaged file was put aside; empty: no trouble
};
/// Opens a day to add to it. Errors: the file is damaged and cannot be put aside, or it cannot be read now.
[[nodiscard]] Result<OpenedDay> open_day(const std::filesystem::path& folder,
                                         std::optional<std::chrono::sys_days> day);
[[nodiscard]] Result<void> keep_day(const std::filesystem::path& folder, const DayCounts& counts);
/// Removes the files of the oldest days beyond `max_days`, including those that were put aside.
void drop_old_days(const std::filesystem::path& folder);

struct ReadCounts {
    std::vector<DayCounts> days; ///< ascending
    DayCounts undated;
    std::vector<std::string> trouble; ///< a sentence for each file that cannot be read
};
/// Only reads. Errors: the folder is missing, or cannot be read.
[[nodiscard]] Result<ReadCounts> read_counts(const std::filesystem::path& folder);

} // namespace frustumscreen::counts
