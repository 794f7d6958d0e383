/// Hands the latest presented picture from the render thread to another thread on request, at most once a second.
///
/// Cost     a requested frame reads the picture back into memory allocated at the start; docs/status.md gives the
///          time. Other frames check one number.
/// Threads  `serve`: the render thread, with the display's context current; it never waits. `take`: one other thread.
/// Errors   the render thread does not serve the request in time.
#pragma once

#include "app/image/image.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <atomic>
#include <stop_token>

namespace frustumscreen::display {
class Display;
}

namespace frustumscreen::show {

class Screenshot {
public:
    static constexpr Nanoseconds between_pictures = std::chrono::seconds(1);
    static constexpr Nanoseconds usual_timeout = std::chrono::seconds(3);

    /// `timeout`: longest wait of `take` for a frame.
    Screenshot(int width, int height, Nanoseconds timeout = usual_timeout)
        : picture_(width, height), timeout_(timeout) {}

    /// Call in every frame, after it was presented.
    void serve(const display::Display& display);

    /// Waits until the previous picture is a second old, and then for a frame. The picture is valid until the next
    /// call; the watchdog's code in its corner is black.
    [[nodiscard]] Result<const image::Image8*> take(const std::stop_token& stop);

private:
    enum class Turn : std::uint8_t { None, Asked, Copying, Done };
    void ask();
    [[nodiscard]] bool comes(MonotonicTime until, const std::stop_token& stop);

    std::atomic<Turn> turn_ = Turn::None;
    image::Image8 picture_; ///< owned by the render thread while it copies, otherwise by the caller of `take`
    Nanoseconds timeout_;
    MonotonicTime earliest_{};
};

} // namespace frustumscreen::show
