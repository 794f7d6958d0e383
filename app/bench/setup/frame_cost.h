/// The cost of a frame in several set-ups: a pack's default level as the exhibit shows it, in even light.
///
/// Poses    the prop at the table's middle, turned in twelve steps once around, seen by the default eye. Every set-up
///          has this place, whatever its zone.
/// Cost     all set-ups take turns in one run, so that a disturbance of the machine affects them equally; frame times
///          as timing.h.
/// Threads  the caller's, which holds a context of its own during the call.
/// Errors   no OpenGL ES; a picture that the driver cannot hold.
#pragma once

#include "app/bench/measures/timing.h"
#include "app/pack/pack.h"
#include "app/settings/settings.h"

#include <span>
#include <vector>

namespace frustumscreen::bench {

struct SetUpCost {
    double times_first = 1.0;     ///< median frame time divided by that of the first set-up
    double cpu_times_first = 1.0; ///< the same for the processor time of all threads
    double samples = 0.0; ///< samples cleared and averaged for a frame, in whole tiles; mean over the poses
};

/// Returns one for each set-up; the first has the ratio 1. All use the first one's eyes.
[[nodiscard]] Result<std::vector<SetUpCost>> frame_costs(std::span<const settings::Settings* const> set_ups,
                                                         const pack::Pack& pack, const Progress& progress);

} // namespace frustumscreen::bench
