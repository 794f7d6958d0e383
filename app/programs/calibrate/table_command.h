/// `frustumscreen-calibrate table`: on the table itself, with the projector, the tracker and two buttons.
#pragma once

#include "app/programs/calibrate/calibrate_request.h"

#include <functional>

namespace frustumscreen {

void add_table_command(CLI::App& app, CalibrateRequest& request, std::function<int()>& chosen);

} // namespace frustumscreen
