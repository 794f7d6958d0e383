/// A pack's states, in the reports of frustumscreen-pack.
///
/// Errors   none: of a pack whose section is damaged nothing is reported (`verify` tells the reason).
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace frustumscreen::programs {

/// [{name, hidden: [cell], behaviour, layer, titles: {language: text}}], all by name; null: none.
[[nodiscard]] nlohmann::ordered_json states_json(const pack::PackDescription& pack);
/// A line for each state; empty without any.
[[nodiscard]] std::string states_text(const pack::PackDescription& pack);

} // namespace frustumscreen::programs
