/// Whether somebody is at the table: the prop or the head moved, or a button was pressed, within half a minute.
///
/// A prop that was left out of the light overnight is not told all night to come back.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/tracking/situation.h"

#include <optional>

namespace frustumscreen {

class Presence {
public:
    static constexpr Nanoseconds stays = std::chrono::seconds(30);
    /// A movement is more than a tracker's noise at rest.
    static constexpr double moved_m = 0.004;
    static constexpr double turned_rad = 0.05;

    /// Returns whether somebody is there.
    bool update(MonotonicTime now, const Situation& situation, bool pressed);

private:
    std::optional<Situation> rested_; ///< where prop and head were at the latest movement
    std::optional<MonotonicTime> moved_;
};

} // namespace frustumscreen
