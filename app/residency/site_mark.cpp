#include "app/residency/site_mark.h"

#include "app/pack/pack.h"
#include "app/scene/scene_level.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace frustumscreen::residency {

namespace {

constexpr double bar = 0.022;                                    ///< of the box's edge
constexpr std::array<std::uint8_t, 4> colour{255, 190, 40, 255}; ///< amber: no earth, roof or grass has it

/// A box between two corners of the unit cube 0..1, with outward triangles.
void add_box(const glm::dvec3& low, const glm::dvec3& high, pack::PackLevel& level) {
    constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    constexpr double max_code = 65535.0;
    const auto first = static_cast<std::uint32_t>(level.vertices.size());
    for (unsigned k = 0; k < 8; ++k) {
        const glm::dvec3 corner((k & 1U) != 0 ? high.x : low.x, (k & 2U) != 0 ? high.y : low.y,
                                (k & 4U) != 0 ? high.z : low.z);
        pack::PackVertex vertex;
        for (int axis = 0; axis < 3; ++axis) {
            vertex.position[static_cast<std::size_t>(axis)] =
                static_cast<std::uint16_t>(std::lround(corner[axis] * max_code));
        }
        vertex.uv = {32768, 32768};
        level.vertices.push_back(vertex);
    }
    for (const auto& [a, b, c, d] : sides) {
        for (const std::uint32_t corner : {a, b, c, a, c, d}) {
            level.indices.push_back(first + corner);
        }
    }
}

pack::PackLevel frame() {
    pack::PackLevel level;
    for (const double side : {0.0, 1.0 - bar}) {
        add_box({0.0, side, 1.0 - bar}, {1.0, side + bar, 1.0}, level);
        add_box({side, bar, 1.0 - bar}, {side + bar, 1.0 - bar, 1.0}, level);
        for (const double other : {0.0, 1.0 - bar}) {
            add_box({side, other, 0.0}, {side + bar, other + bar, 1.0 - bar}, level);
        }
    }
    level.clusters.push_back({.first_index = 0,
                              .index_count = static_cast<std::uint32_t>(level.indices.size()),
                              .centre = {0.0F, 0.0F, 0.5F},
                              .radius = 0.9F});
    return level;
}

} // namespace

SiteMark make_site_mark() {
    scene::SceneLevel level;
    level.mesh = frame();
    level.texels_per_box = 1.0;
    image::Image8 texture(4, 4);
    for (auto& texel : texture.texels) {
        texel = {colour[0], colour[1], colour[2], colour[3]};
    }
    SiteMark mark;
    mark.triangles =
        std::make_shared<const scene::LevelTriangles>(scene::triangles_of(level.mesh, glm::dvec3(1.0)));
    mark.planned_gpu_bytes = scene::gpu_bytes(level, texture);
    mark.data = scene::level_data(level, texture);
    return mark;
}

scene::PlacedLevel placed_mark(const scene::PlacedLevel& mark, const world::RegionBox& region,
                               double metres_per_box) {
    scene::PlacedLevel placed = mark;
    const glm::dvec3 size = metres_per_box * (region.high - region.low);
    const glm::dvec3 middle = metres_per_box * glm::mix(region.low, region.high, 0.5);
    for (int axis = 0; axis < 3; ++axis) {
        placed.prop_from_placed[axis] = glm::dvec4(0.0);
        placed.prop_from_placed[axis][axis] = size[axis];
    }
    placed.prop_from_placed[3] = glm::dvec4(middle.x, middle.y, metres_per_box * region.low.z, 1.0);
    return placed;
}

} // namespace frustumscreen::residency
