/// Keeps, lists and undoes kept calibrations.
///
/// Errors   one line: the folder or file, the problem, the remedy.
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

namespace frustumscreen::programs {

void add_kept_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen);

/// Keeps a good or usable calibration in the settings' folder, dated by this machine's clock, and reports
/// where.
[[nodiscard]] Result<void> keep_touch(const settings::Settings& settings,
                                      const calibration::TouchCalibration& calibration,
                                      std::span<const calibration::Touch> touches);
/// Keeps the projector only; the tracker keeps its place.
[[nodiscard]] Result<void> keep_corners(const settings::Settings& settings,
                                        const calibration::CornerCalibration& calibration,
                                        std::size_t corners);
[[nodiscard]] Result<void> keep_auto(const settings::Settings& settings,
                                     const calibration::AutoCalibration& calibration);

/// A clause on why the eye cannot be kept: there is no calibration to keep it with. Empty if it can.
[[nodiscard]] std::string why_no_eye(const settings::Settings& settings);
/// Keeps a copy of the kept calibration with this eye; projector, tracker and sensor stay.
[[nodiscard]] Result<void> keep_eye(const settings::Settings& settings, const glm::dvec3& eye_in_sensor_m);

/// Keeps `next`, and sets its date.
[[nodiscard]] Result<void> keep_next(const settings::Settings& settings, settings::Calibration next);

} // namespace frustumscreen::programs
