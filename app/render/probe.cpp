#include "app/render/probe.h"

#include <GLES3/gl31.h>

#include <array>
#include <cstddef>
#include <span>

namespace frustumscreen::render {

namespace {

/// sRGB is linear near black: code / 255 / 12.92.
void fill(int x, int width, std::uint8_t grey) {
    const float light = static_cast<float>(grey) / (255.0F * 12.92F);
    glScissor(x, 0, width, 1);
    glClearColor(light, light, light, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
}

} // namespace

bool write_probe(unsigned framebuffer, std::uint8_t code, const PixelRectangle& lit) {
    if (!lit.empty() && lit.x < probe_pixels && lit.y < 1 && lit.x + lit.width > 0 &&
        lit.y + lit.height > 0) {
        return false;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_SCISSOR_TEST);
    for (int begin = 0, end = 0; begin < probe_pixels; begin = end) { // one clear for each run of equal bits
        for (end = begin + 1; end < probe_pixels && probe_bit(code, end) == probe_bit(code, begin); ++end) {
        }
        fill(begin, end - begin, probe_grey(code, begin));
    }
    glDisable(GL_SCISSOR_TEST);
    return true;
}

std::optional<std::uint8_t> read_probe(const image::Image8& picture) {
    if (picture.width < probe_pixels || picture.height < 1) {
        return std::nullopt;
    }
    const std::span<const glm::u8vec4, std::size_t{probe_pixels}> corner(picture.texels.data(), probe_pixels);
    return frustumscreen::read_probe(std::as_bytes(corner));
}

std::optional<std::uint8_t> read_probe(unsigned framebuffer) {
    std::array<std::byte, probe_bytes> corner{};
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, probe_pixels, 1, GL_RGBA, GL_UNSIGNED_BYTE, corner.data());
    return frustumscreen::read_probe(std::span<const std::byte, probe_bytes>(corner));
}

void erase_probe(image::Image8& picture) {
    if (read_probe(picture)) {
        for (int k = 0; k < probe_pixels; ++k) {
            picture.at(k, 0) = {0, 0, 0, 255};
        }
    }
}

} // namespace frustumscreen::render
