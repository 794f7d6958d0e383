/// `frustumscreen record`: what the tracker sends into a pose file, or its packets into a recording.
#pragma once

namespace frustumscreen {

/// The process's exit status.
[[nodiscard]] int record_command(int argc, char** argv);

} // namespace frustumscreen
