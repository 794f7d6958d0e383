/// frustumscreen-calibrate auto without a file: on the table itself, with the projector, a camera, the tracker and two buttons.
///
/// Threads  the main one; the camera has its own.
/// Errors   settings without what it needs, a screen that fails; a camera's or tracker's faults are said on the table and on standard error, and
///          end nothing.
#pragma once

#include "app/programs/calibrate/calibrate_request.h"

namespace frustumscreen {

/// The exit status.
[[nodiscard]] Result<int> calibrate_by_camera(const CalibrateRequest& request);

} // namespace frustumscreen
