/// Time for which the visitor has moved or pressed nothing: neither the prop nor, by more than a standing person
/// sways, the head.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/tracking/tracked_state.h"

#include <optional>

namespace frustumscreen::exhibit {

class Stillness {
public:
    /// Movement beyond a tracker's noise and a hand resting on the prop.
    static constexpr double moved_m = 0.004;
    static constexpr double turned_rad = 0.05;
    /// A step, not a nod.
    static constexpr double stepped_m = 0.12;

    /// Returns the time since the latest movement or press.
    Nanoseconds update(MonotonicTime now, const tracking::TrackedState& tracked_state, bool pressed);

private:
    std::optional<tracking::TrackedState> rested_; ///< poses of prop and head at the latest movement
    MonotonicTime moved_;
};

} // namespace frustumscreen::exhibit
