/// Times at which the portions of a text begin in its recording.
///
/// Unless a text has marks, each portion takes its share of the text as its share of the speech. Because
/// sentences end in pauses, a portion's end is then moved to a nearby pause, preferring long and near ones;
/// later portions are measured from there.
///
/// Threads  pure; any.
#pragma once

#include "firmware_host/sound/prompt.h"

#include <span>
#include <vector>

namespace frustumscreen::residency {

/// `shares`: the portions' lengths, in any unit. Ascending; the first is 0.
[[nodiscard]] std::vector<Nanoseconds> portion_times(std::span<const Nanoseconds> shares,
                                                     const sound::Prompt& prompt);

} // namespace frustumscreen::residency
