/// The artifact's states on a preview page: each as a visitor pins it, with its titles.
///
/// Threads  pure; any.
#pragma once

#include "app/programs/preview/state_pictures.h"

#include <string>
#include <vector>

namespace frustumscreen::programs {

/// Empty without states.
[[nodiscard]] std::string states_part(const std::vector<StatePicture>& states);

} // namespace frustumscreen::programs
