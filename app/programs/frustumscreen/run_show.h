/// The show of a run: the alignment pattern, the artifacts, or the error of a service that has nothing to show.
///
/// Threads  the render thread, with the display's context current.
/// Errors   no artifact can be shown; for the error screen, the pattern cannot be drawn either.
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

namespace frustumscreen::programs {

/// `start`: the run's start, on its own clock.
[[nodiscard]] Result<std::unique_ptr<show::Show>>
make_show(const RunRequest& request, const settings::Settings& settings, const scene::DevicePlan& devices,
          const display::Display& display, MonotonicTime start);

/// Shows the error to the staff on the table, because a service's standard error is not read. Returns `why` if that
/// fails.
[[nodiscard]] Result<std::unique_ptr<show::Show>>
make_error_screen(const settings::Settings& settings, const service::Journal& journal, const Error& why);

} // namespace frustumscreen::programs
