/// `frustumscreen camera`: which cameras are there, how the one of the settings is set, and whether its frames show anything.
#pragma once

namespace frustumscreen {

/// The process's exit status.
[[nodiscard]] int camera_command(int argc, char** argv);

} // namespace frustumscreen
