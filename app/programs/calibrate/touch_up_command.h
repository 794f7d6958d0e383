/// The touch-up of a kept calibration: from a file, as `touch --touch-up` does it, and what `table` needs for it.
///
/// Errors   one line: which file or folder, what, what to do.
/// Threads  the main one.
#pragma once

#include "app/calibration/touch_up.h"
#include "app/programs/calibrate/calibrate_request.h"

namespace frustumscreen {

/// As the newest kept calibration has it, which stands in the settings.
[[nodiscard]] CalibratedTable kept_table_of(const Settings& settings);
/// That there is none.
[[nodiscard]] tl::unexpected<Error> none_kept(const Settings& settings);
/// As another calibration. Where nothing moved nothing is kept. A camera that looks for drift learns anew.
[[nodiscard]] Result<void> keep_touch_up(const Settings& settings, const TouchUp& found);

/// The request has --config. Prints what moved, keeps it where that is asked for, and returns the exit status.
[[nodiscard]] Result<int> touch_up_kept(const CalibrateRequest& request, const Described& described,
                                        const Touches& touches);

} // namespace frustumscreen
