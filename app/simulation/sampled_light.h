/// The linear light of a picture between its pixels.
///
/// Frames   pixels as in pinhole.h: the centre of the top left one is (0.5, 0.5).
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"

#include <glm/glm.hpp>

#include <algorithm>

namespace frustumscreen::simulation {

[[nodiscard]] inline glm::dvec3 linear_texel(const image::Image8& picture, int x, int y) {
    const glm::u8vec4& code =
        picture.at(std::clamp(x, 0, picture.width - 1), std::clamp(y, 0, picture.height - 1));
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    return {linear[code.r], linear[code.g], linear[code.b]};
}

/// The mean of four pixels; with `nearest`, the pixel that holds the place. Beyond the edge as at the edge.
[[nodiscard]] inline glm::dvec3 linear_at(const image::Image8& picture, const glm::dvec2& pixel,
                                          bool nearest) {
    if (nearest) {
        return linear_texel(picture, static_cast<int>(pixel.x), static_cast<int>(pixel.y));
    }
    const glm::dvec2 corner = glm::floor(pixel - 0.5);
    const glm::dvec2 f = pixel - 0.5 - corner;
    const int x = static_cast<int>(corner.x);
    const int y = static_cast<int>(corner.y);
    return glm::mix(glm::mix(linear_texel(picture, x, y), linear_texel(picture, x + 1, y), f.x),
                    glm::mix(linear_texel(picture, x, y + 1), linear_texel(picture, x + 1, y + 1), f.x), f.y);
}

} // namespace frustumscreen::simulation
