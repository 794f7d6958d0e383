/// `frustumscreen config`: prints the resolved, checked settings, their meaning on the table, or a list of all
/// settings.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'config'. Exit status: 0 done, 1 the work failed, 2 wrong use.
int config_command(int argc, char** argv);

} // namespace frustumscreen::programs
