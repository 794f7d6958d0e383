/// Presence of a visitor at the table: the prop, the head or a torch moved, or a button was pressed, within half a minute.
/// Also how long no visitor has been present.
///
/// Guidance depends on it: a prop left out of the light overnight brings no advice all night.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/tracking/tracked_state.h"

#include <optional>

namespace frustumscreen::exhibit {

class Presence {
public:
    static constexpr Nanoseconds stays = std::chrono::seconds(30);
    /// Movement beyond a tracker's noise at rest.
    static constexpr double moved_m = 0.004;
    static constexpr double turned_rad = 0.05;

    /// `active`: a button was pressed, or narration is heard. Returns true if a visitor is present.
    bool update(MonotonicTime now, const tracking::TrackedState& tracked_state, bool active);
    /// True if a visitor was present at the latest update.
    [[nodiscard]] bool is_there() const { return there_; }
    /// True if no visitor has been present for `rest`, or ever.
    [[nodiscard]] bool rests(MonotonicTime now, Nanoseconds rest) const {
        return !moved_ || now - *moved_ >= rest;
    }
    /// The time when the prop last moved or a button was pressed; nothing: never.
    [[nodiscard]] const std::optional<MonotonicTime>& touched() const { return touched_; }
    /// True if the prop is being moved, by 16 mm/s or more.
    [[nodiscard]] bool prop_moves(MonotonicTime now) const {
        return prop_moved_ && now - *prop_moved_ < std::chrono::milliseconds(250);
    }

private:
    std::optional<tracking::TrackedState> rested_; ///< poses of prop and head at the latest movement
    std::optional<MonotonicTime> moved_;
    std::optional<MonotonicTime> touched_;
    std::optional<MonotonicTime> prop_moved_;
    bool there_ = false;
};

} // namespace frustumscreen::exhibit
