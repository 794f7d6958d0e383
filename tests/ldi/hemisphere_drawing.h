/// The hemisphere's patches and cameras as an SVG: docs/ldi.svg.
///
/// Frames   seen from straight above the window, x to the right and y up, the hemisphere's radius 80 units.
/// Threads  pure; any.
#pragma once

#include "app/ldi/hemisphere.h"

#include <string>

namespace frustumscreen::ldi {

[[nodiscard]] std::string svg_of(const Hemisphere& hemisphere);

} // namespace frustumscreen::ldi
