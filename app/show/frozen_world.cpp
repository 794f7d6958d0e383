#include "app/show/frozen_world.h"

#include "app/scene/visible_triangles.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace frustumscreen::show {

void add_level(const scene::SceneLevel& level, const image::Image8& texture, const glm::dvec3& box_size,
               const glm::dmat4& window_from_box, double samples_per_m, FrozenWorld& world) {
    scene::LevelTriangles triangles = scene::triangles_of(level.mesh, box_size);
    ldi::TriangleWorld added;
    added.positions.reserve(triangles.positions.size());
    for (const glm::vec3& position : triangles.positions) {
        const glm::dvec3 at(window_from_box * glm::dvec4(position, 1.0));
        const bool is_first = world.worlds.empty() && added.positions.empty();
        world.box = is_first ? geometry::Box{at, at}
                             : geometry::Box{glm::min(world.box.low, at), glm::max(world.box.high, at)};
        added.positions.emplace_back(at);
    }
    added.indices = std::move(triangles.indices);
    constexpr double codes = 65535.0;
    for (const pack::PackVertex& vertex : level.mesh.vertices) {
        added.texture_places.emplace_back(vertex.uv[0] / codes, vertex.uv[1] / codes);
    }
    const double m_per_box = glm::length(glm::dvec3(window_from_box[0]));
    const int mip = std::min(scene::mip_level(level.texels_per_box, samples_per_m * m_per_box),
                             scene::coarsest_mip_level);
    image::Image8 taken = texture;
    for (int k = 0; k < mip; ++k) {
        taken = image::half_size(taken);
    }
    added.texture = std::make_shared<const image::Image8>(std::move(taken));
    added.cut_out = level.cut_out;
    added.one_sided = true; // as the plan culls it
    world.worlds.push_back(std::move(added));
}

} // namespace frustumscreen::show
