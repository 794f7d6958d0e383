/// The artifact's states on a preview page: what a visitor pins beside it.
///
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"

#include <string>

namespace frustumscreen::programs {

/// Empty without states, or if their section is damaged.
[[nodiscard]] std::string states_part(const pack::PackDescription& pack);

} // namespace frustumscreen::programs
