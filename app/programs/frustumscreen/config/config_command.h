/// `frustumscreen config`: the resolved, checked settings, what they mean on the table, or what settings there are.
#pragma once

namespace frustumscreen {

int config_command(int argc, char** argv);

} // namespace frustumscreen
