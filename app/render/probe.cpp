#include "app/render/probe.h"

#include <GLES3/gl31.h>

#include <array>

namespace frustumscreen {

namespace {

constexpr std::array<std::uint8_t, 2> greys{1, 2}; ///< sRGB codes of a 0 and a 1

/// sRGB is linear near black: code / 255 / 12.92.
void fill(int x, int width, std::uint8_t grey) {
    const float light = static_cast<float>(grey) / (255.0F * 12.92F);
    glScissor(x, 0, width, 1);
    glClearColor(light, light, light, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
}

bool bit(std::uint8_t code, int k) {
    return ((code >> static_cast<unsigned>(k)) & 1U) != 0;
}

/// `pixel(k)`: the corner's k-th.
template <typename Pixel> std::optional<std::uint8_t> code_in(const Pixel& pixel) {
    unsigned code = 0;
    for (int k = 0; k < probe_pixels; ++k) {
        const glm::u8vec4 p = pixel(k);
        if (p.r != p.g || p.g != p.b || (p.r != greys[0] && p.r != greys[1])) {
            return std::nullopt;
        }
        code |= (p.r == greys[1] ? 1U : 0U) << static_cast<unsigned>(k);
    }
    return static_cast<std::uint8_t>(code);
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
        for (end = begin + 1; end < probe_pixels && bit(code, end) == bit(code, begin); ++end) {
        }
        fill(begin, end - begin, greys[bit(code, begin) ? 1 : 0]);
    }
    glDisable(GL_SCISSOR_TEST);
    return true;
}

std::optional<std::uint8_t> read_probe(const Image8& picture) {
    if (picture.width < probe_pixels || picture.height < 1) {
        return std::nullopt;
    }
    return code_in([&picture](int k) { return picture.at(k, 0); });
}

std::optional<std::uint8_t> read_probe(std::span<const std::byte, probe_bytes> corner) {
    return code_in([corner](int k) {
        const auto rgba = corner.subspan(4 * static_cast<std::size_t>(k), 4);
        const auto at = [rgba](std::size_t channel) { return static_cast<std::uint8_t>(rgba[channel]); };
        return glm::u8vec4(at(0), at(1), at(2), at(3));
    });
}

std::optional<std::uint8_t> read_probe(unsigned framebuffer) {
    std::array<std::byte, probe_bytes> corner{};
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, probe_pixels, 1, GL_RGBA, GL_UNSIGNED_BYTE, corner.data());
    return read_probe(corner);
}

void erase_probe(Image8& picture) {
    if (read_probe(picture)) {
        for (int k = 0; k < probe_pixels; ++k) {
            picture.at(k, 0) = {0, 0, 0, 255};
        }
    }
}

} // namespace frustumscreen
