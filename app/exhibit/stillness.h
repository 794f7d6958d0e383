/// For how long the visitor has moved nothing: neither the prop nor, by more than people sway who stand and look, the head; and
/// has pressed nothing.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/tracking/tracked_state.h"

#include <optional>

namespace frustumscreen {

class Stillness {
public:
    /// More than a tracker's noise and a hand that rests on the prop.
    static constexpr double moved_m = 0.004;
    static constexpr double turned_rad = 0.05;
    /// A step, and not a nod.
    static constexpr double stepped_m = 0.12;

    /// Returns the time since the latest movement or press.
    Nanoseconds update(MonotonicTime now, const TrackedState& tracked_state, bool pressed);

private:
    std::optional<TrackedState> rested_; ///< where prop and head were at the latest movement
    MonotonicTime moved_;
};

} // namespace frustumscreen
