/// What a bake that ran as a process of its own has to say for itself.
///
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/run_program.h"

#include <string>

namespace frustumscreen {

/// Why it failed, one sentence; empty if it did not.
[[nodiscard]] std::string sentence_of(const ProgramEnd& end, const ProgramLimits& limits);

} // namespace frustumscreen
