/// Touches up a kept calibration from a file, for `touch --touch-up`, and supplies what `table` needs for it.
///
/// Errors   one line: the file or folder, the problem, the remedy.
/// Threads  the main one.
#pragma once

#include "app/calibration/touch_up.h"
#include "app/programs/calibrate/calibrate_request.h"

namespace frustumscreen::programs {

/// The newest kept calibration, from the settings.
[[nodiscard]] calibration::CalibratedTable kept_table_of(const settings::Settings& settings);
/// The error that no calibration is kept.
[[nodiscard]] tl::unexpected<Error> none_kept(const settings::Settings& settings);
/// Keeps the touched-up table as a new calibration; nothing if nothing moved. A camera that looks for drift
/// learns again.
[[nodiscard]] Result<void> keep_touch_up(const settings::Settings& settings,
                                         const calibration::TouchUp& found);

/// Prints what moved, keeps it on request, and returns the exit status. The request has --config.
[[nodiscard]] Result<int> touch_up_kept(const CalibrateRequest& request, const Described& described,
                                        const calibration::Touches& touches);

} // namespace frustumscreen::programs
