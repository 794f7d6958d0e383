/// The museum's light where a ray meets a source mesh: the light in the textures of a pack baked with light,
/// but at the exact place instead of at texels, and not smoothed.
///
/// Frame    box; directions in its axes.
/// Threads  immutable once built; any.
#pragma once

#include "assets_baked/bake/museum_light.h"
#include "assets_baked/bake/source_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace frustumscreen::bench {

class LitSource {
public:
    LitSource(std::shared_ptr<const bake::SourceMesh> mesh, const glm::dmat4& box_from_file);

    struct Place {
        glm::vec3 at{0.0F};
        glm::vec3 normal{/// Unit, towards the ray's origin; smooth except across sharp edges, as in the bake.
                         0.0F};
    };
    /// The place on triangle `triangle` at the corner weights (1 - u - v, u, v), for a ray of that direction.
    [[nodiscard]] Place place(std::uint32_t triangle, double u, double v, const glm::dvec3& direction) const;
    [[nodiscard]] float light(const Place& place) const { return museum_.at(place.at, place.normal); }

private:
    std::shared_ptr<const bake::SourceMesh> mesh_;
    std::vector<glm::dvec3> points_; ///< one per mesh position
    std::vector<glm::dvec3> normals_;
    bake::SourceScene scene_;
    bake::MuseumLight museum_;
};

} // namespace frustumscreen::bench
