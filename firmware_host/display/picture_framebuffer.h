/// The framebuffer object that the renderer draws the exhibit's picture into, for every kind of display.
///
/// Colour   a texture, SRGB8_ALPHA8: shaders write linear light, a read-back gives sRGB codes; depth 24 and
///          stencil 8 in another, so that a torch's light may ask a pixel's depth. Row 0 is the picture's top row. Initially black.
/// Threads  the creating context is current.
/// Errors   a picture larger than the driver allows.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen::display {

class PictureFramebuffer {
public:
    [[nodiscard]] static Result<PictureFramebuffer> create(int width, int height);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] unsigned name() const { return framebuffer_.get(); }
    [[nodiscard]] unsigned texture() const { return colour_.get(); }

private:
    PictureFramebuffer(int width, int height);

    int width_;
    int height_;
    gl::GlFramebuffer framebuffer_ = gl::GlFramebuffer::generate();
    gl::GlTexture colour_ = gl::GlTexture::generate();
    gl::GlTexture depth_stencil_ = gl::GlTexture::generate();
};

} // namespace frustumscreen::display
