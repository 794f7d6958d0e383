#include "app/show/screenshot.h"

#include "app/render/probe.h"
#include "app/render/read_back.h"
#include "firmware_host/display/display.h"

#include <thread>

namespace frustumscreen::show {

namespace {

constexpr Nanoseconds between_looks = std::chrono::milliseconds(5);

} // namespace

void Screenshot::serve(const display::Display& display) {
    Turn asked = Turn::Asked;
    if (turn_.load(std::memory_order_relaxed) != Turn::Asked ||
        !turn_.compare_exchange_strong(asked, Turn::Copying)) {
        return;
    }
    render::read_colour_into(display.framebuffer(), picture_);
    render::erase_probe(picture_); // the code is for the watchdog, not part of the picture
    turn_ = Turn::Done;
}

Result<const image::Image8*> Screenshot::take(const std::stop_token& stop) {
    while (monotonic_now() < earliest_ && !stop.stop_requested()) {
        std::this_thread::sleep_for(between_looks);
    }
    ask();
    if (!comes(monotonic_now() + timeout_, stop)) {
        return fail(ErrorKind::Internal, "show.no_screenshot",
                    "the exhibit gives no picture; it hangs, is ending, or shows the "
                    "staff what its camera sees");
    }
    earliest_ = monotonic_now() + between_pictures;
    turn_ = Turn::None;
    return &picture_;
}

/// A copy that hung last time may be done by then, and is old. One that still hangs is waited for.
void Screenshot::ask() {
    for (const Turn from : {Turn::None, Turn::Done}) {
        Turn turn = from;
        turn_.compare_exchange_strong(turn, Turn::Asked);
    }
}

/// Waits for the picture. False: the request was withdrawn, unless a copy has begun.
bool Screenshot::comes(MonotonicTime until, const std::stop_token& stop) {
    while (turn_.load() != Turn::Done) {
        if (stop.stop_requested() || monotonic_now() >= until) {
            Turn asked = Turn::Asked;
            turn_.compare_exchange_strong(asked, Turn::None);
            return false;
        }
        std::this_thread::sleep_for(between_looks);
    }
    return true;
}

} // namespace frustumscreen::show
