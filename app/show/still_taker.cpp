#include "app/show/still_taker.h"

#include "app/render/probe.h"
#include "app/render/read_back.h"

#include <utility>

namespace frustumscreen::show {

StillTaker::StillTaker(int count, std::optional<Nanoseconds> length, MonotonicTime start,
                       display::Display& display)
    : display_(display), length_(length), start_(start) {
    for (int k = 0; k < count; ++k) {
        stills_.push_back({image::Image8(display.width(), display.height()), {}, {}});
    }
}

void StillTaker::take(MonotonicTime now, const tracking::TrackedState& shown, bool settled) {
    if (taken_ >= stills_.size() || !length_) {
        return;
    }
    const auto half_part = *length_ / (2 * static_cast<Nanoseconds::rep>(stills_.size()));
    const auto number = static_cast<Nanoseconds::rep>(taken_);
    const Nanoseconds middle = (2 * number + 1) * half_part;
    const Nanoseconds end = (2 * number + 2) * half_part;
    if (now - start_ >= (settled ? middle : end)) {
        keep(now, shown);
    }
}

void StillTaker::keep(MonotonicTime now, const tracking::TrackedState& shown) {
    Still& still = stills_.at(taken_++);
    still.tracked_state = shown;
    still.time = MonotonicTime(now - start_);
    render::read_colour_into(display_.framebuffer(), still.picture);
    render::erase_probe(still.picture); // the code is for the watchdog, not part of the picture
}

std::vector<Still> StillTaker::finish() && {
    stills_.resize(taken_);
    return std::move(stills_);
}

} // namespace frustumscreen::show
