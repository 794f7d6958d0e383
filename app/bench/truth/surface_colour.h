/// The colour of a source mesh at a point: base colour * texture (bilinear, base level, linear light) *
/// vertex colour.
///
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace frustumscreen::bench {

struct SurfaceColour {
    glm::vec3 linear{0.0F};
    float alpha = 1.0F;
};

/// The colour of triangle `triangle` at barycentric (u, v): corner weights (1 - u - v, u, v).
[[nodiscard]] SurfaceColour surface_colour(const bake::SourceMesh& mesh, std::uint32_t triangle, double u,
                                           double v);

} // namespace frustumscreen::bench
