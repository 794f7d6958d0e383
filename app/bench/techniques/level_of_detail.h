/// Levels of detail as anyone would make them: the source mesh simplified to a number of triangles, with its
/// own textures; what the pack's levels are compared with.
///
/// Vertices are joined where position, texture coordinate, colour and material are all equal, so that seams
/// stay where they are and every triangle keeps its material.
///
/// Frame    the source's own coordinates.
/// Threads  pure; any.
/// Library  meshoptimizer 0.18 (Garland & Heckbert 1997 quadrics; this version's quadrics know only
///          positions).
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen {

struct LevelOfDetail {
    std::size_t target = 0; ///< triangles that were asked for; a source of many seams keeps more
    SourceMesh mesh;
    double error = 0.0; ///< reported by the simplifier: a root of mean squares, in the source's units
};

/// One for each target below the source's number of triangles, in ascending order; a target that gives no
/// fewer triangles than the next larger one is left out.
[[nodiscard]] std::vector<LevelOfDetail> levels_of_detail(const SourceMesh& mesh,
                                                          std::span<const std::size_t> targets);

} // namespace frustumscreen
