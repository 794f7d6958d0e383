/// `frustumscreen record`: records the tracker's poses into a pose file, or its packets into a recording.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'record'. Exit status: 0 done, 1 the work failed, 2 wrong use. Ends the process if a device hangs.
[[nodiscard]] int record_command(int argc, char** argv);

} // namespace frustumscreen::programs
