/// What the bench found, as CSV, JSON, SVG and a table for the console.
///
/// Threads  pure; any.
#pragma once

#include "app/bench/error_time.h"

#include <span>
#include <string>

namespace frustumscreen {

/// One row for each technique of each set-up: mean and worst errors, times, ratio to the floor.
[[nodiscard]] std::string summary_csv(std::span<const SetUpResult> results);
/// One row for each technique in each pose.
[[nodiscard]] std::string poses_csv(std::span<const SetUpResult> results);
[[nodiscard]] std::string report_json(std::span<const SetUpResult> results, const std::string& pack_title);
/// Three plots: silhouette, geometric and colour error over cost.
[[nodiscard]] std::string error_time_svg(const SetUpResult& result, const std::string& pack_title);
/// The table that a person reads, with the verdicts below it.
[[nodiscard]] std::string console_table(const SetUpResult& result);

} // namespace frustumscreen
