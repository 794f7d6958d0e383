/// `frustumscreen run`: the exhibit itself.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'run'. Exit status: 0 done (also after SIGTERM or SIGINT), 1 the work failed, 2 wrong use.
[[nodiscard]] int run_command(int argc, char** argv);

} // namespace frustumscreen::programs
