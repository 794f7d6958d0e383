/// Advice on a set-up: a table for a person, CSV for plots, and settings to paste.
///
/// Threads  pure; any.
#pragma once

#include "app/bench/setup/advice.h"

#include <string>

namespace frustumscreen::bench {

/// One line for the present settings (`as_it_is`) and one for each choice; the best is marked. Includes the cost of a
/// frame if it was measured.
[[nodiscard]] std::string setup_table(const SetUpChoice& now, const std::vector<SetUpChoice>& choices,
                                      const AdviceOptions& options);
[[nodiscard]] std::string setup_csv(const SetUpChoice& now, const std::vector<SetUpChoice>& choices);
/// [projector] and [prop] of a choice, in TOML.
[[nodiscard]] std::string setup_toml(const SetUpChoice& choice);

} // namespace frustumscreen::bench
