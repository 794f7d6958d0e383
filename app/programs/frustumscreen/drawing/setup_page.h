/// The settings' meaning on the table, in words for the person who mounts the projector: the picture, a pixel's size,
/// where the prop stays lit, how much light its faces receive, and what an error of mounting or tracking costs.
///
/// Units    millimetres, metres, degrees and pixels, each written out; table coordinates.
/// Threads  pure; any.
#pragma once

#include "app/settings/settings.h"

#include <string>

namespace frustumscreen::programs {

/// Ends with a line break.
[[nodiscard]] std::string setup_page(const settings::Settings& settings);

} // namespace frustumscreen::programs
