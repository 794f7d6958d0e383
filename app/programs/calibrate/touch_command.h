/// frustumscreen-calibrate touch: from touches to projector and tracker.
///
/// Threads  the main one.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/common/command_line.h"

#include <functional>
#include <span>

namespace frustumscreen {

/// Every key is always there; what is not known is null.
[[nodiscard]] nlohmann::ordered_json touch_json(const TouchCalibration& calibration);
/// Millimetres; of each touch, numbered from 1.
[[nodiscard]] nlohmann::ordered_json mm_json(double mean_m, double worst_m);
/// By how many of 100 places or calibrations, as text.
[[nodiscard]] nlohmann::ordered_json within_json(const PictureShares& shares);
[[nodiscard]] nlohmann::ordered_json rows_json(std::span<const TouchResidual> residuals);
/// Sets `chosen` if this is the command; what it returns is the exit status.
void add_touch_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen);

} // namespace frustumscreen
