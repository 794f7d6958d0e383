/// The display: a GL ES context and the picture that the projector shows.
///
/// Threads  the render thread alone; construction makes the context current on it.
#pragma once

#include "firmware_host/base/device_state.h"
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
    /// GL name of the framebuffer to draw the next picture into: colour a texture, sRGB 8-bit; depth 24, stencil 8.
    /// Row 0 of a read-back is the picture's top row (as `Pinhole::clip_from_point`).
    [[nodiscard]] virtual unsigned framebuffer() const = 0;
    /// How many presents old the framebuffer's content is; 0 = undefined, 1 = the last picture.
    [[nodiscard]] virtual int buffer_age() const = 0;
    /// Tells which part of the framebuffer was drawn into since the last present; if not called, all of it
    /// was.
    virtual void changed(const PixelRectangle& /*part*/) {}
    /// Shows what was drawn; returns the time at which it was (or will be) lit.
    [[nodiscard]] virtual Result<MonotonicTime> present(MonotonicTime now) = 0;
    /// Keeps the projector dark on purpose: in every frame in place of `present`, which lights it again.
    [[nodiscard]] virtual Result<void> stay_dark() { return {}; }
    /// When the frame after the one that began at `now` should begin, for one frame every `period`: on a
    /// flip, where there are flips.
    [[nodiscard]] virtual MonotonicTime next_frame(MonotonicTime now, Nanoseconds period) const {
        return now + period;
    }
    /// Reads the first pixels of the top row, at most `probe_pixels`, as they are shown now, RGBA codes.
    /// False: nothing is shown; what was presented is in the framebuffer.
    [[nodiscard]] virtual bool read_shown(std::span<std::byte> /*rgba*/) const { return false; }
    /// What was presented is shown, or there is no screen that could show it.
    [[nodiscard]] virtual bool settled() const { return true; }
    /// Until when the device's thread promises to be heard from again; nothing: it has none.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return std::nullopt; }
    [[nodiscard]] virtual std::string name() const = 0;
    /// The device's state in one plain sentence, valid until the next call; empty: nothing can fail.
    [[nodiscard]] virtual std::string_view state() const { return {}; }
    /// Whether the device that the settings ask for can be used; its id is that of the sentence that `state` says.
    [[nodiscard]] virtual DeviceCondition condition() const { return {}; }
};

} // namespace frustumscreen
