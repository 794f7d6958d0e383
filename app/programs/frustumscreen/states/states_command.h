/// `frustumscreen states`: prints the exhibit's states, as a page or as a graph.
#pragma once

namespace frustumscreen::programs {

int states_command(int argc, char** argv);

} // namespace frustumscreen::programs
