/// frustumscreen-calibrate touch: computes projector and tracker from touches.
///
/// Threads  the main one.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/common/command_line.h"

#include <functional>
#include <span>

namespace frustumscreen::programs {

/// Every key is always present; unknown values are null.
[[nodiscard]] nlohmann::ordered_json touch_json(const calibration::TouchCalibration& calibration);
/// Mean and worst, in millimetres.
[[nodiscard]] nlohmann::ordered_json mm_json(double mean_m, double worst_m);
/// The distances that hold at 68 and 95 % of the places, and at the worst place, in millimetres.
[[nodiscard]] nlohmann::ordered_json within_json(const calibration::PictureShares& shares);
[[nodiscard]] nlohmann::ordered_json rows_json(std::span<const calibration::TouchResidual> residuals);
/// Sets `chosen` if this is the command; `chosen` returns the exit status.
void add_touch_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen);

} // namespace frustumscreen::programs
