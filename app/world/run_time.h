/// How far a run of a behaviour is. In whole nanoseconds, so that a loop keeps its phase however long it repeats.
///
/// Threads  pure; any.
#pragma once

#include "app/world/behaviour.h"
#include "firmware_host/base/time.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::world {

/// The length of one run: 1 ns to `max_seconds`.
[[nodiscard]] inline Nanoseconds length_of(const Behaviour& behaviour) {
    const double seconds = std::fmin(std::fmax(behaviour.seconds, 0.0), max_seconds);
    return std::max(Nanoseconds(1), Nanoseconds(std::llround(seconds * 1e9)));
}

/// True if a run ends by itself.
[[nodiscard]] inline bool runs_out(const Behaviour& behaviour) {
    return !behaviour.repeats && !behaviour.stays;
}

/// The time on the behaviour's curves `elapsed` after its start.
[[nodiscard]] inline double curve_seconds(const Behaviour& behaviour, Nanoseconds elapsed) {
    const Nanoseconds length = length_of(behaviour);
    elapsed = std::max(elapsed, Nanoseconds(0));
    return to_seconds(behaviour.repeats ? elapsed % length : std::min(elapsed, length));
}

} // namespace frustumscreen::world
