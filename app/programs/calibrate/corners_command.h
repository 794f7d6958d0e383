/// frustumscreen-calibrate corners: from the picture's measured corners to the projector.
///
/// Threads  the main one.
#pragma once

#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/common/command_line.h"

#include <functional>

namespace frustumscreen {

/// Sets `chosen` if this is the command; what it returns is the exit status.
void add_corners_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen);

} // namespace frustumscreen
