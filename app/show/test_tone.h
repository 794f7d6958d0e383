/// Three short notes for the staff, as loud as the exhibit's speech (-23 LUFS): a good volume for them is good for
/// speech.
///
/// Threads  pure; any.
#pragma once

#include "firmware_host/sound/prompt.h"

namespace frustumscreen::show {

[[nodiscard]] sound::SharedPrompt test_tone();

} // namespace frustumscreen::show
