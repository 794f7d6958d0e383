#include "app/bench/techniques/memory_picture.h"

#include <algorithm>

namespace frustumscreen::bench {

Result<MemoryPicture> MemoryPicture::create(const Kiosk& kiosk) {
    TRY(OffscreenTarget target, make_target(kiosk.width(), kiosk.height(), GL_SRGB8_ALPHA8));
    return MemoryPicture(std::move(target), kiosk.width(), kiosk.height());
}

void MemoryPicture::show(const Kiosk& kiosk, const PixelRectangle& lit) {
    begin_codes(kiosk.framebuffer, kiosk.width(), kiosk.height());
    if (!lit.empty()) {
        glBindTexture(GL_TEXTURE_2D, target_.colour.get());
        glPixelStorei(GL_UNPACK_ROW_LENGTH, kiosk.width());
        glTexSubImage2D(GL_TEXTURE_2D, 0, lit.x, lit.y, lit.width, lit.height, GL_RGBA, GL_UNSIGNED_BYTE,
                        &codes.at(lit.x, lit.y));
        glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, target_.framebuffer.get());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, kiosk.framebuffer);
        glBlitFramebuffer(lit.x, lit.y, lit.x + lit.width, lit.y + lit.height, lit.x, lit.y,
                          lit.x + lit.width, lit.y + lit.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        for (int y = lit.y; y < lit.y + lit.height; ++y) {
            std::fill_n(&codes.at(lit.x, y), lit.width, glm::u8vec4(0));
        }
    }
    end_codes();
}

} // namespace frustumscreen::bench
