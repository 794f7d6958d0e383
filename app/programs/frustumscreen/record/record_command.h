/// `frustumscreen record`: records the tracker's poses into a pose file, or its packets into a recording.
#pragma once

namespace frustumscreen::programs {

/// Returns the process's exit status.
[[nodiscard]] int record_command(int argc, char** argv);

} // namespace frustumscreen::programs
