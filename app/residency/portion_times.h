/// When the portions of a text begin in its recording.
///
/// Where nobody has marked them, each takes the share of the speech that it has of the text; and as sentences end in pauses, its
/// end is moved to the pause nearby that is longest and nearest. What comes after it is measured from there.
///
/// Threads  pure; any.
#pragma once

#include "firmware_host/sound/prompt.h"

#include <span>
#include <vector>

namespace frustumscreen {

/// `shares`: the portions' lengths, in any unit. Ascending; the first is 0.
[[nodiscard]] std::vector<Nanoseconds> portion_times(std::span<const Nanoseconds> shares,
                                                     const Prompt& prompt);

} // namespace frustumscreen
