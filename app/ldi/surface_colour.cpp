#include "app/ldi/surface_colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::ldi {

namespace {

/// Shares of the corners where the ray meets the triangle's plane (Möller and Trumbore 1997), moved into the triangle.
std::array<double, 3> shares_at(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& eye,
                                const glm::dvec3& ray) {
    const glm::dvec3 ab = corners[1] - corners[0];
    const glm::dvec3 ac = corners[2] - corners[0];
    const glm::dvec3 across = glm::cross(ray, ac);
    const double determinant = glm::dot(across, ab);
    const glm::dvec3 from_corner = eye - corners[0];
    const double to_b = glm::dot(from_corner, across);
    const double to_c = glm::dot(ray, glm::cross(from_corner, ab));
    if (determinant == 0.0 || std::fmax(std::fabs(to_b), std::fabs(to_c)) > 1e6 * std::fabs(determinant)) {
        return {1.0, 0.0, 0.0}; // the ray meets it edge-on
    }
    const double b = std::max(0.0, to_b / determinant);
    const double c = std::max(0.0, to_c / determinant);
    const double both = std::max(1.0, b + c);
    return {1.0 - (b + c) / both, b / both, c / both};
}

glm::u8vec4 rounded(const glm::vec4& codes) {
    return glm::u8vec4(glm::clamp(codes, 0.0F, 255.0F) + 0.5F);
}

/// The texture's colour, bilinear between the middles of texels; the texture repeats.
glm::u8vec4 texel_at(const image::Image8& texture, const glm::dvec2& place) {
    if (texture.width < 1 || texture.height < 1 || !std::isfinite(place.x + place.y)) {
        return glm::u8vec4(255);
    }
    const glm::dvec2 size(texture.width, texture.height);
    const glm::dvec2 texels = (place - glm::floor(place)) * size - 0.5;
    const glm::dvec2 low = glm::floor(texels);
    const glm::vec2 share(texels - low);
    const auto texel = [&](int right, int down) {
        const int x = (static_cast<int>(low.x) + right + texture.width) % texture.width;
        const int y = (static_cast<int>(low.y) + down + texture.height) % texture.height;
        return glm::vec4(texture.at(x, y));
    };
    return rounded(glm::mix(glm::mix(texel(0, 0), texel(1, 0), share.x),
                            glm::mix(texel(0, 1), texel(1, 1), share.x), share.y));
}

} // namespace

glm::u8vec4 surface_colour(const TriangleWorld& world, std::uint32_t triangle, const glm::dvec3& eye,
                           const glm::dvec3& ray) {
    const std::uint32_t* indices = &world.indices[3 * std::size_t{triangle}];
    const std::array<double, 3> shares =
        shares_at({glm::dvec3(world.positions[indices[0]]), glm::dvec3(world.positions[indices[1]]),
                   glm::dvec3(world.positions[indices[2]])},
                  eye, ray);
    if (world.colours.size() == world.positions.size()) {
        glm::vec4 codes(0.0F);
        for (std::size_t k = 0; k < 3; ++k) {
            codes += static_cast<float>(shares[k]) * glm::vec4(world.colours[indices[k]]);
        }
        return rounded(codes);
    }
    if (world.texture != nullptr && world.texture_places.size() == world.positions.size()) {
        glm::dvec2 place(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            place += shares[k] * glm::dvec2(world.texture_places[indices[k]]);
        }
        return texel_at(*world.texture, place);
    }
    return glm::u8vec4(255);
}

} // namespace frustumscreen::ldi
