#include "app/render/picture_upload.h"

#include <GLES2/gl2ext.h>

namespace frustumscreen::render {

PictureUpload::PictureUpload(int width, int height)
    : width_(width), height_(height), texture_(gl::GlTexture::generate()),
      source_(gl::GlFramebuffer::generate()) {
    glBindTexture(GL_TEXTURE_2D, texture_.get());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, width, height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source_.get());
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.get(), 0);
}

void PictureUpload::put(const image::Image8& picture) {
    glBindTexture(GL_TEXTURE_2D, texture_.get());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE,
                    picture.texels.data());
}

void PictureUpload::show_again(unsigned framebuffer, const glm::ivec2& place) {
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source_.get());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glBlitFramebuffer(0, 0, width_, height_, place.x, place.y, place.x + width_, place.y + height_,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void PictureUpload::show_in(unsigned framebuffer, const PixelRectangle& part) {
    glEnable(GL_FRAMEBUFFER_SRGB_EXT); // otherwise codes are averaged in place of light
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source_.get());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glBlitFramebuffer(0, 0, width_, height_, part.x, part.y, part.x + part.width, part.y + part.height,
                      GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

} // namespace frustumscreen::render
