/// The bench's results as CSV, JSON and a table for the console.
///
/// Threads  pure; any.
#pragma once

#include "app/bench/measures/verdicts.h"

#include <span>
#include <string>

namespace frustumscreen::bench {

/// One row per technique of each set-up: mean and worst errors, times, ratio to the floor; `best_eye_image`
/// is 0 for a two-pass picture that another eye image of the same mesh betters, else 1.
[[nodiscard]] std::string summary_csv(std::span<const SetUpResult> results);
/// The limits that the verdicts check, for each level; an empty field means no limit.
[[nodiscard]] std::string limits_csv();
/// One row per technique in each pose.
[[nodiscard]] std::string poses_csv(std::span<const SetUpResult> results);
/// `pack_figures`: the verdicts on the pack's own figures.
[[nodiscard]] std::string report_json(std::span<const SetUpResult> results, const std::string& pack_title,
                                      std::span<const LimitVerdict> pack_figures);
/// Every verdict: its set-up ('pack': the pack's own figures), the limit, the measured value, held or missed.
[[nodiscard]] std::string verdicts_csv(std::span<const SetUpResult> results,
                                       std::span<const LimitVerdict> pack_figures);
/// The table for a reader, with the verdicts below it.
[[nodiscard]] std::string console_table(const SetUpResult& result);

} // namespace frustumscreen::bench
