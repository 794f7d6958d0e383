/// Standard levels of detail, to compare with the pack's levels: the source mesh simplified to a number of
/// triangles, with its own textures.
///
/// Vertices are joined where position, texture coordinate, colour and material are all equal, so seams stay
/// in place and every triangle keeps its material.
///
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen::bench {

struct LevelOfDetail {
    std::size_t target = 0; ///< requested triangles; a source with many seams keeps more
    bake::SourceMesh mesh;
    double error = 0.0; ///< reported by the simplifier: root mean square, in the source's units
};

/// One level per target below the source's number of triangles, in ascending order; a target that does not
/// reduce the triangles of the next larger one is skipped.
[[nodiscard]] std::vector<LevelOfDetail> levels_of_detail(const bake::SourceMesh& mesh,
                                                          std::span<const std::size_t> targets);

} // namespace frustumscreen::bench
