/// The display: a GL ES context and the picture that the projector shows.
///
/// Threads  the render thread alone; construction makes the context current on it.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <string>

namespace frustumscreen {

class Display {
public:
    virtual ~Display() = default;
    [[nodiscard]] virtual int width() const = 0;
    [[nodiscard]] virtual int height() const = 0;
    /// GL name of the framebuffer to draw the next picture into: colour sRGB 8-bit, depth 24, stencil 8.
    /// Row 0 of a read-back is the picture's top row (conventions of `Pinhole::clip_from_point`).
    [[nodiscard]] virtual unsigned framebuffer() const = 0;
    /// How many presents ago the framebuffer held what it holds now; 0 = undefined, 1 = the last picture.
    [[nodiscard]] virtual int buffer_age() const = 0;
    /// Shows what was drawn; the time at which it was (or will be) lit.
    [[nodiscard]] virtual Result<MonotonicTime> present(MonotonicTime now) = 0;
    [[nodiscard]] virtual std::string name() const = 0;
};

} // namespace frustumscreen
