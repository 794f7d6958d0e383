/// frustumscreen-calibrate sheet: writes the tag sheet for printing.
///
/// Threads  the main one.
#pragma once

#include "app/calibration/board.h"
#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/common/command_line.h"

#include <functional>

namespace frustumscreen::programs {

/// The tag sheet for the settings' prop.
[[nodiscard]] Result<calibration::Board> board_of(const settings::Settings& settings);

void add_sheet_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen);

} // namespace frustumscreen::programs
