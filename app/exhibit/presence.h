/// Whether somebody is at the table: the prop or the head moved, or a button was pressed, within half a minute; and for how long
/// nobody has been.
///
/// A prop that was left out of the light overnight is not told all night to come back.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/tracking/tracked_state.h"

#include <optional>

namespace frustumscreen {

class Presence {
public:
    static constexpr Nanoseconds stays = std::chrono::seconds(30);
    /// A movement is more than a tracker's noise at rest.
    static constexpr double moved_m = 0.004;
    static constexpr double turned_rad = 0.05;

    /// `active`: a button was pressed, or somebody is being told something. Returns whether somebody is there.
    bool update(MonotonicTime now, const TrackedState& tracked_state, bool active);
    /// Nobody has been there for so long, or ever.
    [[nodiscard]] bool rests(MonotonicTime now, Nanoseconds rest) const {
        return !moved_ || now - *moved_ >= rest;
    }
    /// When the prop moved last or a button was pressed; nothing: never.
    [[nodiscard]] const std::optional<MonotonicTime>& touched() const { return touched_; }
    /// Whether the prop is being moved, by 16 mm a second or more.
    [[nodiscard]] bool prop_moves(MonotonicTime now) const {
        return prop_moved_ && now - *prop_moved_ < std::chrono::milliseconds(250);
    }

private:
    std::optional<TrackedState> rested_; ///< where prop and head were at the latest movement
    std::optional<MonotonicTime> moved_;
    std::optional<MonotonicTime> touched_;
    std::optional<MonotonicTime> prop_moved_;
};

} // namespace frustumscreen
