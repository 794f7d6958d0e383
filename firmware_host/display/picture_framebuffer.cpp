#include "firmware_host/display/picture_framebuffer.h"

#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace frustumscreen {

Result<PictureFramebuffer> PictureFramebuffer::create(int width, int height) {
    GLint limit = 0;
    GLint renderbuffer_limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer_limit);
    limit = std::min(limit, renderbuffer_limit);
    if (width < 1 || height < 1 || width > limit || height > limit) {
        return fail(
            ErrorKind::BadConfiguration,
            fmt::format("display: a picture of {} x {} pixels; this driver draws 1 to {} on each side", width,
                        height, limit));
    }
    PictureFramebuffer picture;
    picture.width_ = width;
    picture.height_ = height;
    glGenFramebuffers(1, &picture.framebuffer_);
    glGenTextures(1, &picture.colour_);
    glGenRenderbuffers(1, &picture.depth_stencil_);
    glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer_);
    glBindTexture(GL_TEXTURE_2D, picture.colour_);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, width, height);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture.colour_, 0);
    glBindRenderbuffer(GL_RENDERBUFFER, picture.depth_stencil_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                              picture.depth_stencil_);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || glGetError() != GL_NO_ERROR) {
        return fail(
            ErrorKind::BadConfiguration,
            fmt::format(
                "display: the driver cannot hold a picture of {} x {} pixels; configure a smaller one", width,
                height));
    }
    glBindTexture(GL_TEXTURE_2D, 0);
    return picture;
}

PictureFramebuffer::~PictureFramebuffer() {
    if (framebuffer_ != 0) {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteTextures(1, &colour_);
        glDeleteRenderbuffers(1, &depth_stencil_);
    }
}

PictureFramebuffer::PictureFramebuffer(PictureFramebuffer&& other) noexcept
    : width_(other.width_), height_(other.height_), framebuffer_(std::exchange(other.framebuffer_, 0U)),
      colour_(other.colour_), depth_stencil_(other.depth_stencil_) {}

PictureFramebuffer& PictureFramebuffer::operator=(PictureFramebuffer&& other) noexcept {
    std::swap(width_, other.width_);
    std::swap(height_, other.height_);
    std::swap(framebuffer_, other.framebuffer_);
    std::swap(colour_, other.colour_);
    std::swap(depth_stencil_, other.depth_stencil_);
    return *this;
}

} // namespace frustumscreen
