/// The numbers of one day, and their file.
///
///     {"frustumscreen_counts": 1, "day": "2026-11-27", "hours": [{"hour": 10, "visits": 3, "ms": 184000}, ...],
///      "artifacts": [{"name": "Amphora", "visits": 2, "ms": 120000}, ...], "languages": [{"name": "en", ...}, ...]}
///
/// Visits   of an hour: those that began in it; of an artifact or a language: those in which it was shown.
/// Time     the totals of the hours, of the artifacts and of the languages are equal; a file in which they differ
///          is damaged.
/// Units    milliseconds, so that sums are exact.
/// Threads  values; any.
/// Errors   one line: what is wrong in the text.
#pragma once

#include "app/counts/visit_counter.h"
#include "firmware_host/base/result.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen::counts {

struct Tally {
    std::uint64_t visits = 0;
    std::uint64_t ms = 0;
    [[nodiscard]] bool operator==(const Tally&) const = default;
    Tally& operator+=(const Tally& other) {
        visits += other.visits;
        ms += other.ms;
        return *this;
    }
};
using Tallies = std::map<std::string, Tally>;

struct DayCounts {
    std::optional<std::chrono::sys_days> day; ///< local; nothing: the clock was wrong
    std::array<Tally, 24> hours{};
    Tallies artifacts, languages; ///< by name: the pack's title, the language's tag
    [[nodiscard]] bool operator==(const DayCounts&) const = default;

    /// `hour`: local time at the end of the piece.
    void add(const VisitPiece& piece, std::size_t hour);
    void add(const DayCounts& other);
    [[nodiscard]] Tally all() const;
};

/// Further names are added up under `other_names`.
inline constexpr std::size_t max_counted_names = 200;
inline constexpr std::string_view other_names = "...";

[[nodiscard]] std::string write_day_counts(const DayCounts& counts);
[[nodiscard]] Result<DayCounts> parse_day_counts(std::string_view text);

} // namespace frustumscreen::counts
