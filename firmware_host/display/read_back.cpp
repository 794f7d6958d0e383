#include "firmware_host/display/read_back.h"

#include "firmware_host/display/egl_context.h"

#include <GLES2/gl2.h>
#include <GLES2/gl2ext.h>
#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <cassert>
#include <utility>

namespace frustumscreen::display {

Result<ReadBack> ReadBack::create(PixelSize screen) {
    ReadBack read_back(screen);
    if (!has_gl_extension("GL_EXT_read_format_bgra") ||
        glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return fail(ErrorKind::BadConfiguration, "display.no_read_back",
                    "the GPU that draws cannot hand over pictures of {} x {} pixels", screen.width,
                    screen.height);
    }
    return read_back;
}

ReadBack::ReadBack(PixelSize screen) : screen_(screen) {
    glBindRenderbuffer(GL_RENDERBUFFER, colour_.get());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, screen.width, screen.height);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.get());
}

void ReadBack::fill(const PictureCopy& copy, const PictureFramebuffer& picture, const PixelRectangle& part,
                    std::span<std::byte> memory, std::size_t stride) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    const PixelRectangle drawn = copy.draw(picture, screen_, TopRow::First, part);
    if (drawn.empty()) {
        return;
    }
    const std::size_t first =
        static_cast<std::size_t>(drawn.y) * stride + 4 * static_cast<std::size_t>(drawn.x);
    assert(static_cast<std::size_t>(screen_.height) * stride <= memory.size());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(stride / 4));
    glReadPixels(drawn.x, drawn.y, drawn.width, drawn.height, GL_BGRA_EXT, GL_UNSIGNED_BYTE,
                 memory.subspan(first).data());
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
}

} // namespace frustumscreen::display
