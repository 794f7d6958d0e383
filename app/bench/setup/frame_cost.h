/// What a frame costs in several set-ups: a pack's default level as the exhibit shows it, in even light.
///
/// Poses    the prop at the table's middle, turned in twelve steps once around, seen by the default eye: a place that
///          every set-up has, whatever its zone.
/// Cost     all set-ups take turns in one run, so that whatever disturbs the machine disturbs them alike; frame times
///          as timing.h.
/// Threads  the one that calls; it has a context of its own meanwhile.
/// Errors   no OpenGL ES; a picture that the driver cannot hold.
#pragma once

#include "app/bench/measures/timing.h"
#include "app/pack/pack.h"
#include "app/settings/settings.h"

#include <span>
#include <vector>

namespace frustumscreen {

struct SetUpCost {
    double times_first = 1.0;     ///< the median frame time, over that of the first set-up
    double cpu_times_first = 1.0; ///< the same of the processor's time, all threads
    double samples = 0.0;         ///< cleared and averaged for a frame, in whole tiles; a mean over the poses
};

/// One for each set-up; the first has the ratio 1. All have the first one's eyes.
[[nodiscard]] Result<std::vector<SetUpCost>> frame_costs(std::span<const Settings* const> set_ups,
                                                         const Pack& pack, const Progress& progress);

} // namespace frustumscreen
