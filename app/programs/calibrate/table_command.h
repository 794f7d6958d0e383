/// `frustumscreen-calibrate table`: calibrates on the table itself, with the projector, the tracker and two
/// buttons.
#pragma once

#include "app/programs/calibrate/calibrate_request.h"
#include "app/programs/common/command_line.h"

#include <functional>

namespace frustumscreen::programs {

void add_table_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen);

} // namespace frustumscreen::programs
