/// The procedure of a calibration by a camera on the table itself, with the projector, the camera, the tracker and two buttons.
///
/// Threads  the main one; the camera has its own.
/// Errors   the settings lack something that it needs, the screen fails, or it ends without a calibration. A
///          fault of the camera or the tracker is reported on the table and on standard error, and ends
///          nothing.
#pragma once

#include "app/calibration/board.h"
#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/calibrate/calibration_way.h"
#include "app/programs/calibrate/table_devices.h"

namespace frustumscreen::programs {

/// Runs the procedure and keeps its result. `settings` have a camera. `crosses_follow`: Back goes on to the
/// crosses instead of leaving.
[[nodiscard]] Result<WayEnd> measure_by_camera(const settings::Settings& settings,
                                               const CalibrateRequest& request,
                                               const calibration::Board& board, TableDevices& devices,
                                               bool crosses_follow);

/// Runs `frustumscreen-calibrate auto` without a file; returns the exit status.
[[nodiscard]] Result<int> calibrate_by_camera(const CalibrateRequest& request);

} // namespace frustumscreen::programs
