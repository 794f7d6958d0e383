/// frustumscreen-calibrate touch: from touches to projector and tracker.
///
/// Threads  the main one.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "app/programs/calibrate/calibrate_request.h"

#include <functional>

namespace frustumscreen {

/// Every key is always there; what is not known is null.
[[nodiscard]] nlohmann::ordered_json touch_json(const TouchCalibration& calibration);
[[nodiscard]] TouchSetup touch_setup(const Described& described, const CalibrateRequest& request);
/// Sets `chosen` if this is the command; what it returns is the exit status.
void add_touch_command(CLI::App& app, CalibrateRequest& request, std::function<int()>& chosen);

} // namespace frustumscreen
