/// The findings of a check: lines for one scan, a table for several, JSON for programs.
///
/// Threads  pure; any.
#pragma once

#include "app/programs/bake/check_scan.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace frustumscreen::programs {

/// A line for each column, loss and guess; ends with a line break. Empty if the scan could not be read.
[[nodiscard]] std::string check_lines(const CheckedScan& scan);
/// A line for each scan under the columns' headings, or why it cannot be baked, and a line with the counts; ends with a
/// line break.
[[nodiscard]] std::string check_table(std::span<const CheckedScan> scans);
/// {scans: [{scan, can_be_baked, fault, id, the columns' keys, torches: [], lost: [], guessed: []}]}; fault and id
/// only if it cannot be baked, the columns only if it was read
[[nodiscard]] nlohmann::ordered_json check_json(std::span<const CheckedScan> scans);

} // namespace frustumscreen::programs
