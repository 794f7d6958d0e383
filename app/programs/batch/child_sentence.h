/// The result of a bake that ran as a separate process, as a sentence.
///
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/run_program.h"

#include <string>

namespace frustumscreen::programs {

/// Why it failed, one sentence; empty if it succeeded.
[[nodiscard]] std::string sentence_of(const ProgramEnd& end, const ProgramLimits& limits);

} // namespace frustumscreen::programs
