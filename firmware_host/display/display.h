/// The display: a GL ES context and the picture that an output shows, the projector or the screen.
///
/// Threads  the render thread only; construction makes the context current on it. With several displays, the context of one
///          is current at a time.
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

namespace frustumscreen::display {

class Display {
public:
    virtual ~Display() = default;
    /// Makes its context current, for drawing, presenting and destruction. False: the driver refuses.
    [[nodiscard]] virtual bool make_current() const { return true; }
    [[nodiscard]] virtual int width() const = 0;
    [[nodiscard]] virtual int height() const = 0;
    /// GL name of the framebuffer for the next picture: the colour attachment is a texture, 8-bit sRGB; depth
    /// 24, stencil 8. Row 0 of a read-back is the picture's top row (as `Pinhole::clip_from_point`).
    [[nodiscard]] virtual unsigned framebuffer() const = 0;
    /// Age of the framebuffer's content in presents; 0 = undefined, 1 = the last picture.
    [[nodiscard]] virtual int buffer_age() const = 0;
    /// Announces the part of the framebuffer that was drawn since the last present. Without a call the whole
    /// framebuffer counts as drawn.
    virtual void changed(const PixelRectangle& /*part*/) {}
    /// Shows the drawn picture; returns the time at which it was (or will be) lit.
    [[nodiscard]] virtual Result<MonotonicTime> present(MonotonicTime now) = 0;
    /// Whether `present` would not wait for the previous picture; never waits itself. Call it in each frame in which
    /// neither `present` nor `stay_dark` is called.
    [[nodiscard]] virtual bool takes_picture() { return true; }
    /// Keeps the projector dark on purpose. Call it in every frame in place of `present`, which lights the
    /// projector again.
    [[nodiscard]] virtual Result<void> stay_dark() { return {}; }
    /// The time at which the frame after the one that began at `now` should begin, for one frame every
    /// `period`; on a flip if the display has flips.
    [[nodiscard]] virtual MonotonicTime next_frame(MonotonicTime now, Nanoseconds period) const {
        return now + period;
    }
    /// Reads the first pixels of the shown top row, at most `probe_pixels`, as RGBA codes. False: nothing is
    /// shown; the presented picture is in the framebuffer.
    [[nodiscard]] virtual bool read_shown(std::span<std::byte> /*rgba*/) const { return false; }
    /// Whether the presented picture is shown, or no screen can show it.
    [[nodiscard]] virtual bool settled() const { return true; }
    /// Time until which the device's thread has promised a sign of life; nullopt: there is no such thread.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return std::nullopt; }
    [[nodiscard]] virtual std::string name() const = 0;
    /// The device's state in one plain sentence, valid until the next call; empty for a display that cannot
    /// fail.
    [[nodiscard]] virtual std::string_view state() const { return {}; }
    /// Whether the device that the settings ask for can be used; its id is that of the sentence that `state` says.
    [[nodiscard]] virtual DeviceCondition condition() const { return {}; }
};

} // namespace frustumscreen::display
