/// `frustumscreen guide`: for each pose of a file, what the visitor sees, which of it is lit, and the advice.
#pragma once

namespace frustumscreen::programs {

int guide_command(int argc, char** argv);

} // namespace frustumscreen::programs
