/// The tag sheet of the automatic calibration, to print: its tags, the place of the prop, and the tag for the
/// prop's top.
///
/// Shape    SVG, A3, true size when printed at 100 %.
/// Threads  pure; any.
#pragma once

#include "app/calibration/board.h"

#include <string>
#include <string_view>

namespace frustumscreen::drawing {

/// `name` names the settings.
[[nodiscard]] std::string board_sheet(const calibration::Board& board, std::string_view name);

} // namespace frustumscreen::drawing
