/// The results of the stability cases, as a table for the console and CSV.
///
/// Threads  pure; any.
#pragma once

#include "app/bench/stability/stability.h"

#include <span>
#include <string>

namespace frustumscreen::bench {

struct MeasuredCase {
    std::string theme;
    std::string name;
    StabilityResult result;
};

[[nodiscard]] bool all_held(std::span<const MeasuredCase> cases);
/// Columns case, quantity, bound, observed, verdict; and a line with their counts.
[[nodiscard]] std::string stability_table(std::span<const MeasuredCase> cases);
[[nodiscard]] std::string stability_csv(std::span<const MeasuredCase> cases);

[[nodiscard]] std::string step_error_csv(std::span<const StepError> smoothers,
                                         std::span<const StepError> program);

} // namespace frustumscreen::bench
