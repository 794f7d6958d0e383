/// Pictures for the codecs' tests.
#pragma once

#include "app/image/image.h"

#include <random>

namespace frustumscreen::image {

/// Noise; with alpha, texels of alpha 0 have colours too.
inline Image8 noise(int width, int height, bool with_alpha) {
    std::mt19937 random(7);
    Image8 image(width, height);
    for (glm::u8vec4& texel : image.texels) {
        const auto code = static_cast<std::uint32_t>(random());
        texel = {code & 255U, (code >> 8) & 255U, (code >> 16) & 255U,
                 !with_alpha         ? 255U
                 : (code >> 30) == 0 ? 0U
                                     : code >> 24};
    }
    return image;
}

inline Image8 smooth(int width, int height) {
    Image8 image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image.at(x, y) = {x * 255 / width, y * 255 / height, 90, 255};
        }
    }
    return image;
}

} // namespace frustumscreen::image
