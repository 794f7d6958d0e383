/// Three short notes for the staff, as loud as the exhibit speaks (-23 LUFS): what is right for them is right for speech.
///
/// Threads  pure; any.
#pragma once

#include "firmware_host/sound/prompt.h"

namespace frustumscreen {

[[nodiscard]] SharedPrompt test_tone();

} // namespace frustumscreen
