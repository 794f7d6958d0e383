/// `frustumscreen camera`: lists the cameras, how the settings' camera is set up, and whether its frames show anything.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'camera'. Exit status: 0 done; 1 the work failed, the settings' camera is not well or, with
/// --is-on, the settings have none; 2 wrong use. Ends the process if the device hangs.
[[nodiscard]] int camera_command(int argc, char** argv);

} // namespace frustumscreen::programs
