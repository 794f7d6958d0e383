/// `frustumscreen config`: prints the resolved, checked settings, their meaning on the table, or a list of all
/// settings.
#pragma once

namespace frustumscreen::programs {

int config_command(int argc, char** argv);

} // namespace frustumscreen::programs
