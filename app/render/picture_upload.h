/// Puts a picture made on the CPU into a display's framebuffer as it is. For test pictures, not for the
/// exhibit.
///
/// Threads  the render thread.
#pragma once

#include "app/image/image.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen {

class PictureUpload {
public:
    PictureUpload(int width, int height);
    /// `picture` has the size given above; sRGB codes arrive unchanged, row 0 at the picture's top.
    void show(const Image8& picture, unsigned framebuffer) {
        put(picture);
        show_again(framebuffer);
    }
    /// The same in two steps: the picture is kept, and shown as often as need be.
    void put(const Image8& picture);
    /// `place`: of its upper left corner in the framebuffer.
    void show_again(unsigned framebuffer, const glm::ivec2& place = glm::ivec2(0));

private:
    int width_;
    int height_;
    GlTexture texture_;
    GlFramebuffer source_;
};

} // namespace frustumscreen
