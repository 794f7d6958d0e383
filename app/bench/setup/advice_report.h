/// Advice on a set-up as text: for a person, as CSV for plots, and as settings to paste.
///
/// Threads  pure; any.
#pragma once

#include "app/bench/setup/advice.h"

#include <string>

namespace frustumscreen {

/// One line for the settings as they are and one for each choice; the best is marked.
[[nodiscard]] std::string setup_table(const Settings& settings, const std::vector<SetUpChoice>& choices,
                                      const AdviceOptions& options);
[[nodiscard]] std::string setup_csv(const Settings& settings, const std::vector<SetUpChoice>& choices);
/// [projector] and [prop] of a choice, in TOML.
[[nodiscard]] std::string setup_toml(const SetUpChoice& choice);

} // namespace frustumscreen
