/// The touch-up of a kept calibration, as `touch --touch-up` does it.
///
/// Errors   one line: which file or folder, what, what to do.
/// Threads  the main one.
#pragma once

#include "app/calibration/touch.h"
#include "app/programs/calibrate/calibrate_request.h"

namespace frustumscreen {

/// The request has --config. Prints what moved, keeps it where that is asked for, and returns the exit status.
[[nodiscard]] Result<int> touch_up_kept(const CalibrateRequest& request, const Described& described,
                                        const Touches& touches);

} // namespace frustumscreen
