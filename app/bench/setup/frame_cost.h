/// The cost of a frame in several set-ups: a pack's default level or a relief as the exhibit shows it, in even light, with
/// both eyes where the settings have a layout for them.
///
/// Poses    the prop at the table's middle, turned in twelve steps once around, seen by the default eye. Every set-up
///          has this place, whatever its zone.
/// Cost     a frame draws what changed since the one before, as in the exhibit. All set-ups take turns in one run, so
///          that a disturbance of the machine affects them equally; frame times as timing.h.
/// Threads  the caller's, which holds a context of its own during the call.
/// Errors   no OpenGL ES; a picture that the driver cannot hold.
#pragma once

#include "app/bench/measures/timing.h"
#include "app/pack/pack.h"
#include "app/relief/block_relief.h"
#include "app/settings/settings.h"

#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::bench {

struct SetUpCost {
    double times_first = 1.0;     ///< median frame time divided by that of the first set-up
    double cpu_times_first = 1.0; ///< the same for the processor time of all threads
    /// Samples of the default level that are cleared and averaged for one eye's frame, in whole tiles; mean over the poses.
    double samples = 0.0;
};

/// Returns one for each set-up; the first has the ratio 1. All use the first one's eyes. `relief`: null for the default
/// level.
[[nodiscard]] Result<std::vector<SetUpCost>>
frame_costs(std::span<const settings::Settings* const> set_ups, const pack::Pack& pack,
            const Progress& progress, const std::shared_ptr<const relief::BlockRelief>& relief = nullptr);

} // namespace frustumscreen::bench
