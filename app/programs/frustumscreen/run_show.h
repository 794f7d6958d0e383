/// What a run shows: the alignment pattern, the artifacts, or, where a service has nothing to show, why.
///
/// Threads  the render thread, with the display's context current.
/// Errors   no artifact can be shown; for the excuse, the pattern cannot be drawn either.
#pragma once

#include "app/programs/frustumscreen/run_request.h"
#include "app/scene/device_plan.h"
#include "app/settings/settings.h"
#include "app/show/show.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"
#include "firmware_host/display/display.h"
#include "firmware_host/service/journal.h"

#include <memory>

namespace frustumscreen {

/// `start`: when the run begins, by its own clock.
[[nodiscard]] Result<std::unique_ptr<Show>> make_show(const RunRequest& request, const Settings& settings,
                                                      const DevicePlan& devices, const Display& display,
                                                      MonotonicTime start);

/// Shows the error on the table for the staff, since nobody reads a service's standard error. Where that fails, the same error.
[[nodiscard]] Result<std::unique_ptr<Show>> make_excuse(const Settings& settings, const Journal& journal,
                                                        const Error& why);

} // namespace frustumscreen
