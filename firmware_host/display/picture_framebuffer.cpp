#include "firmware_host/display/picture_framebuffer.h"

#include <fmt/format.h>

namespace frustumscreen::display {

Result<PictureFramebuffer> PictureFramebuffer::create(int width, int height) {
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (width < 1 || height < 1 || width > limit || height > limit) {
        return fail(ErrorKind::BadConfiguration, "display.picture_size",
                    "display: the picture has {} x {} pixels, and this driver draws 1 to {} on each side; "
                    "configure a picture of another size",
                    width, height, limit);
    }
    PictureFramebuffer picture(width, height);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || glGetError() != GL_NO_ERROR) {
        return fail(ErrorKind::BadConfiguration, "display.no_room_for_picture",
                    "display: the driver cannot hold a picture of {} x {} pixels; configure a smaller one",
                    width, height);
    }
    glBindTexture(GL_TEXTURE_2D, 0);
    // A display may copy the picture before the renderer has drawn it; clear it, so no uninitialised memory
    // is read.
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    glFinish(); // a display copies from another context
    return picture;
}

PictureFramebuffer::PictureFramebuffer(int width, int height) : width_(width), height_(height) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glBindTexture(GL_TEXTURE_2D, colour_.get());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, width, height);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.get(), 0);
    glBindTexture(GL_TEXTURE_2D, depth_stencil_.get());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH24_STENCIL8, width, height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, depth_stencil_.get(),
                           0);
}

} // namespace frustumscreen::display
