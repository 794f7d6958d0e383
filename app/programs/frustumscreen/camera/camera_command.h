/// `frustumscreen camera`: lists the cameras, how the settings' camera is set up, and whether its frames show anything.
#pragma once

namespace frustumscreen::programs {

/// Returns the process's exit status.
[[nodiscard]] int camera_command(int argc, char** argv);

} // namespace frustumscreen::programs
