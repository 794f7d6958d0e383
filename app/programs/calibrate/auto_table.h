/// The procedure of a calibration by a camera on the table itself, with the projector, the camera, the tracker and two buttons.
///
/// Threads  the main one; the camera has its own.
/// Errors   settings without what it needs, a screen that fails, an end without a calibration; a camera's or tracker's faults are said on the
///          table and on standard error, and end nothing.
#pragma once

#include "app/calibration/board.h"
#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/calibrate/calibration_way.h"
#include "app/programs/calibrate/table_devices.h"

namespace frustumscreen {

/// From the first word on the table to the kept file. `settings` have a camera. `crosses_follow`: Back goes on to them, and not out.
[[nodiscard]] Result<WayEnd> measure_by_camera(const Settings& settings, const CalibrateRequest& request,
                                               const Board& board, TableDevices& devices,
                                               bool crosses_follow);

/// frustumscreen-calibrate auto without a file: the exit status.
[[nodiscard]] Result<int> calibrate_by_camera(const CalibrateRequest& request);

} // namespace frustumscreen
