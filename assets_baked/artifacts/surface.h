/// A mesh from curved patches: each is a function of (u, v), and all share one budget of triangles.
///
/// Frame    millimetres, +Y up; dP/du x dP/dv points outward.
/// Threads  pure; `make_mesh` uses all cores, and its result does not depend on their number.
#pragma once

#include "app/image/image.h"
#include "assets_baked/bake/source_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace frustumscreen::artifacts {

struct SurfacePoint {
    glm::dvec3 position{0.0};
    glm::vec2 uv{0.0F};
};

struct Patch {
    std::function<SurfacePoint(double u, double v)> at; ///< u and v in 0..1
    double length_u_mm = 1.0;                           ///< size, to spread triangles evenly
    double length_v_mm = 1.0;
    int min_u = 4; ///< fewest cells
    int min_v = 2;
    bool pole_at_start = false; ///< the whole edge v = 0 is one point
    bool pole_at_end = false;
    int columns_of = -1; ///< index of an earlier patch with equal columns: they share an edge
};

/// One material with `texture`. The number of triangles is within 5 % of `triangles` if that is at least
/// 1000.
[[nodiscard]] bake::SourceMesh make_mesh(const std::vector<Patch>& patches, std::int64_t triangles,
                                         image::Image8 texture);

} // namespace frustumscreen::artifacts
