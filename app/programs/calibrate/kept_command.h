/// What is kept of calibrations: kept, listed, undone.
///
/// Errors   one line: which folder or file, what, what to do.
/// Threads  the main one.
#pragma once

#include "app/calibration/calibrate_auto.h"
#include "app/calibration/calibrate_touch.h"
#include "app/calibration/corners.h"
#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/common/command_line.h"

#include <functional>
#include <span>
#include <string>

namespace frustumscreen {

void add_kept_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen);

/// Keeps a calibration that is good or usable in the settings' folder, dated by this machine's clock, and says where.
[[nodiscard]] Result<void> keep_touch(const Settings& settings, const TouchCalibration& calibration,
                                      std::span<const Touch> touches);
/// The projector alone: the tracker stays where it was.
[[nodiscard]] Result<void> keep_corners(const Settings& settings, const CornerCalibration& calibration,
                                        std::size_t corners);
[[nodiscard]] Result<void> keep_auto(const Settings& settings, const AutoCalibration& calibration);

/// Why the eye cannot be kept, as a half sentence: there is no calibration to keep it with. Empty: it can.
[[nodiscard]] std::string why_no_eye(const Settings& settings);
/// The kept calibration with this eye in it becomes the newest one; projector, tracker and sensor stay.
[[nodiscard]] Result<void> keep_eye(const Settings& settings, const glm::dvec3& eye_in_sensor_m);

/// Keeps this one; when it was made is set here.
[[nodiscard]] Result<void> keep_next(const Settings& settings, Calibration next);

} // namespace frustumscreen
