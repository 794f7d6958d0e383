/// Copies a picture made on the processor into a display's framebuffer, unchanged or scaled. For test pictures, not
/// for the exhibit.
///
/// Threads  the render thread.
#pragma once

#include "app/image/image.h"
#include "firmware_host/base/pixel_rectangle.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen::render {

class PictureUpload {
public:
    PictureUpload(int width, int height);
    /// `picture` has the size given above; sRGB codes arrive unchanged, row 0 at the picture's top.
    void show(const image::Image8& picture, unsigned framebuffer) {
        put(picture);
        show_again(framebuffer);
    }
    /// The same in two steps: the picture is stored, and shown as often as needed.
    void put(const image::Image8& picture);
    /// `place`: position of its upper left corner in the framebuffer.
    void show_again(unsigned framebuffer, const glm::ivec2& place = glm::ivec2(0));
    /// Scales the stored picture to `part` of the framebuffer; light is averaged between neighbouring pixels.
    void show_in(unsigned framebuffer, const PixelRectangle& part);

    [[nodiscard]] PixelSize size() const { return {width_, height_}; }

private:
    int width_;
    int height_;
    gl::GlTexture texture_;
    gl::GlFramebuffer source_;
};

} // namespace frustumscreen::render
