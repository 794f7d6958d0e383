/// `frustumscreen states`: prints the exhibit's states, as a page or as a graph.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'states'. Exit status: 0 done, 2 wrong use.
int states_command(int argc, char** argv);

} // namespace frustumscreen::programs
