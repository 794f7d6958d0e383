/// `frustumscreen guide`: for each pose of a file, what the visitor sees, which of it is lit, and the advice.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'guide'. Exit status: 0 done, 1 the work failed, 2 wrong use.
int guide_command(int argc, char** argv);

} // namespace frustumscreen::programs
