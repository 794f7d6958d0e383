#include "app/bench/measures/picture_shift.h"

#include <cassert>

namespace frustumscreen::bench {

namespace {

/// The sum of the channels in linear light.
image::Image<float> light_of(const image::Image8& picture) {
    const std::array<float, 256>& linear = image::linear_from_srgb8();
    image::Image<float> light(picture.width, picture.height);
    for (std::size_t k = 0; k < picture.texels.size(); ++k) {
        const glm::u8vec4& texel = picture.texels[k];
        light.texels[k] = linear[texel.r] + linear[texel.g] + linear[texel.b];
    }
    return light;
}

glm::dvec2 gradient(const image::Image<float>& light, int x, int y) {
    return 0.5 * glm::dvec2(light.at(x + 1, y) - light.at(x - 1, y), light.at(x, y + 1) - light.at(x, y - 1));
}

} // namespace

std::optional<glm::dvec2> picture_shift(const image::Image8& truth, const image::Image8& drawn) {
    assert(truth.width == drawn.width && truth.height == drawn.height);
    const image::Image<float> a = light_of(truth);
    const image::Image<float> b = light_of(drawn);
    glm::dmat2 normal(0.0);
    glm::dvec2 right(0.0);
    for (int y = 1; y < a.height - 1; ++y) {
        for (int x = 1; x < a.width - 1; ++x) {
            const glm::dvec2 slope = 0.5 * (gradient(a, x, y) + gradient(b, x, y));
            normal += glm::outerProduct(slope, slope);
            right -= static_cast<double>(b.at(x, y) - a.at(x, y)) * slope;
        }
    }
    // If all edges run in one direction, the shift along them is undetermined.
    constexpr double min_condition = 1e-3;
    const double trace = normal[0][0] + normal[1][1];
    if (!(glm::determinant(normal) > min_condition * trace * trace)) {
        return std::nullopt;
    }
    return glm::inverse(normal) * right;
}

} // namespace frustumscreen::bench
