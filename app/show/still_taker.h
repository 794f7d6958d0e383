/// The pictures that a run keeps: one from the middle of each of its parts, or soon after it if a fade is running
/// then.
///
/// Threads  the render thread, with the display's context current. `take` allocates nothing.
#pragma once

#include "app/image/image.h"
#include "app/tracking/tracked_state.h"
#include "firmware_host/display/display.h"

#include <optional>
#include <vector>

namespace frustumscreen::show {

struct Still {
    image::Image8 picture;
    tracking::TrackedState tracked_state;
    MonotonicTime time; ///< since the run's start
};

class StillTaker {
public:
    /// `count` pictures, spread over `length`; without a length only `keep` takes one.
    StillTaker(int count, std::optional<Nanoseconds> length, MonotonicTime start, display::Display& display);

    /// Keeps the shown picture if one is due. `settled`: nothing in it fades.
    void take(MonotonicTime now, const tracking::TrackedState& shown, bool settled);
    /// Keeps the shown picture, whatever the time.
    void keep(MonotonicTime now, const tracking::TrackedState& shown);
    /// True if none was taken and at least one was wanted.
    [[nodiscard]] bool lacks_all() const { return taken_ == 0 && !stills_.empty(); }
    [[nodiscard]] std::vector<Still> finish() &&;

private:
    display::Display& display_;
    std::optional<Nanoseconds> length_;
    MonotonicTime start_;
    std::vector<Still> stills_; ///< space for all of them
    std::size_t taken_ = 0;
};

} // namespace frustumscreen::show
