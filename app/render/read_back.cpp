#include "app/render/read_back.h"

#include <GLES3/gl31.h>

namespace frustumscreen::render {

image::Image8 read_colour(unsigned framebuffer, int width, int height) {
    image::Image8 image(width, height);
    read_colour_into(framebuffer, image);
    return image;
}

void read_colour_into(unsigned framebuffer, image::Image8& image) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.texels.data());
    for (glm::u8vec4& texel : image.texels) {
        texel.a = 255;
    }
}

void wait_until_drawn() {
    glFinish();
}

} // namespace frustumscreen::render
