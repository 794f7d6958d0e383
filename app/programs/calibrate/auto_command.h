/// frustumscreen-calibrate auto: from rests of the prop to projector and tracker.
///
/// Threads  the main one.
#pragma once

#include "app/programs/calibrate/calibrate_request.h"

#include <functional>

namespace frustumscreen {

/// Sets `chosen` if this is the command; what it returns is the exit status.
void add_auto_command(CLI::App& app, CalibrateRequest& request, std::function<int()>& chosen);

} // namespace frustumscreen
