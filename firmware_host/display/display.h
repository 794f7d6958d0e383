/// The display: a GL ES context and the picture that the projector shows.
///
/// Threads  the render thread alone; construction makes the context current on it.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"
#include "firmware_host/display/letterbox.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace frustumscreen {

class Display {
public:
    virtual ~Display() = default;
    [[nodiscard]] virtual int width() const = 0;
    [[nodiscard]] virtual int height() const = 0;
    /// GL name of the framebuffer to draw the next picture into: colour sRGB 8-bit, depth 24, stencil 8.
    /// Row 0 of a read-back is the picture's top row (as `Pinhole::clip_from_point`).
    [[nodiscard]] virtual unsigned framebuffer() const = 0;
    /// How many presents ago the framebuffer held what it holds now; 0 = undefined, 1 = the last picture.
    [[nodiscard]] virtual int buffer_age() const = 0;
    /// The part of the framebuffer that was drawn into since the last present; not told: all of it.
    virtual void changed(const PixelRectangle& /*part*/) {}
    /// Shows what was drawn; the time at which it was (or will be) lit.
    [[nodiscard]] virtual Result<MonotonicTime> present(MonotonicTime now) = 0;
    /// When the frame after the one that began at `now` should begin, for one frame every `period`: on a
    /// flip, where there are flips.
    [[nodiscard]] virtual MonotonicTime next_frame(MonotonicTime now, Nanoseconds period) const {
        return now + period;
    }
    /// The first pixels of the top row, `code_pixels` at most, as they are shown now, RGBA codes. False:
    /// nothing is shown; then the framebuffer has what was presented.
    [[nodiscard]] virtual bool read_shown(std::span<std::byte> /*rgba*/) const { return false; }
    /// What was presented is on, or there is nothing that it could be on.
    [[nodiscard]] virtual bool settled() const { return true; }
    /// Until when the device's thread promises to be heard of again; nothing: it has none.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return std::nullopt; }
    [[nodiscard]] virtual std::string name() const = 0;
    /// How the device is, in one plain sentence; empty: there is nothing that could fail. Good until the next
    /// call.
    [[nodiscard]] virtual std::string_view state() const { return {}; }
};

} // namespace frustumscreen
