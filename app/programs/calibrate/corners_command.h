/// frustumscreen-calibrate corners: computes the projector from the picture's measured corners.
///
/// Threads  the main one.
#pragma once

#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/common/command_line.h"

#include <functional>

namespace frustumscreen::programs {

/// Sets `chosen` if this is the command; `chosen` returns the exit status.
void add_corners_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen);

} // namespace frustumscreen::programs
