/// The board of the automatic calibration as a sheet to print: its tags, where the prop stands, and the tag for the prop's top.
///
/// Shape    SVG, A3, true size: printed at 100 % its lengths are those of the board.
/// Threads  pure; any.
#pragma once

#include "app/calibration/board.h"

#include <string>
#include <string_view>

namespace frustumscreen {

/// `name` says of which settings it is.
[[nodiscard]] std::string board_sheet(const Board& board, std::string_view name);

} // namespace frustumscreen
