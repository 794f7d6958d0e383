/// The light on a prop in the hand whose pose is lost: its sensor or its tags are covered, and the prop moves on unseen. A
/// short gap changes nothing; then the picture fades out where it was last seen, and fades in when the pose is back.
///
/// Time     a closed form of the pose's age and of the time when it came back: the rhythm of frames does not matter. `now`
///          never goes back.
/// Threads  a value; one caller. Allocates nothing.
#pragma once

#include "firmware_host/base/time.h"

namespace frustumscreen::exhibit {

class HandFade {
public:
    static constexpr Nanoseconds held = std::chrono::milliseconds(300);     ///< since the last good pose
    static constexpr Nanoseconds each_way = std::chrono::milliseconds(600); ///< fade out, or fade in

    /// Brightness, 0..1. `age`: of the last good pose.
    [[nodiscard]] double at(MonotonicTime now, Nanoseconds age);

private:
    /// Linear in time, 0..1.
    [[nodiscard]] double level(MonotonicTime now) const;

    bool lost_ = false;
    double from_ = 1.0; ///< level when it was lost or came back
    MonotonicTime since_;
};

} // namespace frustumscreen::exhibit
