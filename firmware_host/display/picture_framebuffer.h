/// The framebuffer object that the renderer draws the exhibit's picture into, the same for every display.
///
/// Colour   a texture, SRGB8_ALPHA8: shaders write linear light, a read-back gives sRGB codes; depth 24,
/// stencil 8.
///          Row 0 is the picture's top row.
/// Threads  the context that made it is current.
/// Errors   a picture larger than the driver allows.
#pragma once

#include "firmware_host/base/result.h"

namespace frustumscreen {

class PictureFramebuffer {
public:
    [[nodiscard]] static Result<PictureFramebuffer> create(int width, int height);
    ~PictureFramebuffer();
    PictureFramebuffer(PictureFramebuffer&& other) noexcept;
    PictureFramebuffer& operator=(PictureFramebuffer&& other) noexcept;
    PictureFramebuffer(const PictureFramebuffer&) = delete;
    PictureFramebuffer& operator=(const PictureFramebuffer&) = delete;

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] unsigned name() const { return framebuffer_; }
    [[nodiscard]] unsigned texture() const { return colour_; }

private:
    PictureFramebuffer() = default;

    int width_ = 0;
    int height_ = 0;
    unsigned framebuffer_ = 0;
    unsigned colour_ = 0;
    unsigned depth_stencil_ = 0;
};

} // namespace frustumscreen
