/// Hands the picture that was presented last from the render thread to somebody who asks for it, at most once a second.
///
/// Cost     a frame that is asked for it reads the picture back, into memory taken at the start; docs/status.md says how long
///          that takes. All other frames look at one number.
/// Threads  `serve`: the render thread, with the display's context current; it waits for nobody. `take`: one other thread.
/// Errors   the exhibit's thread does not come by in time.
#pragma once

#include "app/image/image.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <atomic>
#include <stop_token>

namespace frustumscreen {

class Display;

class Screenshot {
public:
    static constexpr Nanoseconds between_pictures = std::chrono::seconds(1);
    static constexpr Nanoseconds usual_patience = std::chrono::seconds(3);

    /// `patience`: how long `take` waits for a frame.
    Screenshot(int width, int height, Nanoseconds patience = usual_patience)
        : picture_(width, height), patience_(patience) {}

    /// Call in every frame, after it was presented.
    void serve(const Display& display);

    /// Waits for a frame, and before that until the picture before is a second old. The picture is valid until the next call;
    /// the watchdog's code in its corner is black.
    [[nodiscard]] Result<const Image8*> take(const std::stop_token& stop);

private:
    enum class Turn : std::uint8_t { Nobody, Asked, Copying, Done };
    void ask();
    [[nodiscard]] bool comes(MonotonicTime until, const std::stop_token& stop);

    std::atomic<Turn> turn_ = Turn::Nobody;
    Image8 picture_; ///< of the render thread while it copies, else of the one who asks
    Nanoseconds patience_;
    MonotonicTime earliest_{};
};

} // namespace frustumscreen
