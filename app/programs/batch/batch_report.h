/// The report of a batch: as CSV for programs, as a page for people.
///
/// Format   CSV as in RFC 4180, UTF-8, with a header line. The page is self-contained; it links to the
///          objects' previews next to it.
/// Threads  pure; any.
#pragma once

#include "app/programs/batch/stamp.h"

#include <span>
#include <string>

namespace frustumscreen::programs {

[[nodiscard]] std::string report_csv(std::span<const BatchRow> rows);
/// `seconds`: duration of the run; `skipped`: folders without anything to bake.
[[nodiscard]] std::string report_page(std::span<const BatchRow> rows, std::string_view title, double seconds,
                                      std::span<const std::string> skipped);

/// Number of rows with this status.
[[nodiscard]] std::size_t count_of(std::span<const BatchRow> rows, BatchStatus status);
/// "12 objects: 10 baked, 1 unchanged, 1 failed"; zero counts are omitted.
[[nodiscard]] std::string summary(std::span<const BatchRow> rows);

} // namespace frustumscreen::programs
