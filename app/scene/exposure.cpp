#include "app/scene/exposure.h"

#include <algorithm>
#include <array>

namespace frustumscreen::scene {

namespace {

constexpr double share_below = 0.98;
constexpr int opaque_from = 128; ///< alpha threshold of the shaders' cut-out

/// Sample points in a triangle, each for a quarter of its area; barycentric weights.
constexpr std::array<glm::dvec3, 4> places_in_triangle{
    glm::dvec3(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0), glm::dvec3(2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0),
    glm::dvec3(1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0), glm::dvec3(1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0)};

const glm::u8vec4& texel(const image::Image8& texture, const glm::dvec2& uv) {
    const auto along = [](double share, int size) {
        return std::clamp(static_cast<int>(share * size), 0, size - 1);
    };
    return texture.at(along(uv.x, texture.width), along(uv.y, texture.height));
}

/// Surface area per largest channel code.
std::array<double, 256> areas_by_code(const pack::PackLevel& level, const glm::dvec3& box_size,
                                      const image::Image8& texture) {
    std::array<double, 256> areas{};
    for (std::size_t k = 0; k + 2 < level.indices.size(); k += 3) {
        std::array<glm::dvec3, 3> corner;
        std::array<glm::dvec2, 3> uv;
        for (std::size_t j = 0; j < 3; ++j) {
            const pack::PackVertex& vertex = level.vertices[level.indices[k + j]];
            corner.at(j) = box_size * glm::dvec3(vertex.position[0], vertex.position[1], vertex.position[2]);
            uv.at(j) = glm::dvec2(vertex.uv[0], vertex.uv[1]) / 65535.0;
        }
        const double area = glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
        for (const glm::dvec3& place : places_in_triangle) {
            const glm::u8vec4& seen = texel(texture, place[0] * uv[0] + place[1] * uv[1] + place[2] * uv[2]);
            if (seen.a >= opaque_from) {
                areas.at(std::max({seen.r, seen.g, seen.b})) += area;
            }
        }
    }
    return areas;
}

} // namespace

double exposure_of(const pack::PackLevel& level, const glm::dvec3& box_size, const image::Image8& texture,
                   int highlight_code) {
    const std::array<double, 256> areas = areas_by_code(level, box_size, texture);
    double total = 0.0;
    for (const double area : areas) {
        total += area;
    }
    if (highlight_code == 0 || !(total > 0.0)) {
        return 1.0;
    }
    std::size_t code = 0;
    for (double below = areas[0]; below < share_below * total && code < 255; below += areas.at(code)) {
        ++code;
    }
    const double highlight = image::linear_from_srgb(highlight_code / 255.0);
    const double now = image::linear_from_srgb(static_cast<double>(code) / 255.0);
    return std::min(max_exposure, highlight / std::max(now, 1e-6));
}

} // namespace frustumscreen::scene
