/// A picture computed on the processor, and its transfer into the kiosk's framebuffer.
///
/// Units    sRGB codes; pixels.
/// Threads  the one whose context is current; several threads may write `codes` between two calls of `show`.
#pragma once

#include "app/bench/techniques/peer_gl.h"
#include "app/bench/techniques/technique.h"
#include "app/image/image.h"
#include "firmware_host/base/pixel_rectangle.h"

namespace frustumscreen::bench {

class MemoryPicture {
public:
    /// Errors: the driver has no memory.
    [[nodiscard]] static Result<MemoryPicture> create(const Kiosk& kiosk);

    image::Image8 codes; ///< black between pictures

    /// Clears the kiosk's framebuffer, copies the lit part into it, and clears that part to black here.
    void show(const Kiosk& kiosk, const PixelRectangle& lit);

private:
    MemoryPicture(OffscreenTarget target, int width, int height)
        : codes(width, height, glm::u8vec4(0)), target_(std::move(target)) {}
    OffscreenTarget target_;
};

} // namespace frustumscreen::bench
