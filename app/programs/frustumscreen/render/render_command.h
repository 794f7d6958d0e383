/// `frustumscreen render`: replays a pose file into pictures, without devices.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'render'. Exit status: 0 done, 1 the work failed, 2 wrong use.
[[nodiscard]] int render_command(int argc, char** argv);

} // namespace frustumscreen::programs
