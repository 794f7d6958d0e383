/// The report of a batch: as CSV for programs, as a page for people.
///
/// Format   CSV as RFC 4180 has it, in UTF-8, with a header line. The page needs no other file; it links to the objects' previews
///          beside it.
/// Threads  pure; any.
#pragma once

#include "app/programs/batch/stamp.h"

#include <array>
#include <span>
#include <string>

namespace frustumscreen {

[[nodiscard]] std::string report_csv(std::span<const BatchRow> rows);
/// `seconds`: that the run took; `passed_over`: folders in which there was nothing to bake.
[[nodiscard]] std::string report_page(std::span<const BatchRow> rows, std::string_view title, double seconds,
                                      std::span<const std::string> passed_over);

/// How many rows have that status.
[[nodiscard]] std::size_t count_of(std::span<const BatchRow> rows, BatchStatus status);
/// "12 objects: 10 baked, 1 unchanged, 1 failed"; nothing is said of what there is none of.
[[nodiscard]] std::string summary(std::span<const BatchRow> rows);

} // namespace frustumscreen
