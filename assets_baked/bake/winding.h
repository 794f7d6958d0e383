/// Triangles whose corners run the other way round than those of their neighbours, so that their outside is within.
///
/// Shape    neighbours share an edge, by equal positions; edges of more than two triangles connect nothing. A part that
///          runs the other way round as a whole does not count: a bake takes the side that visitors see.
/// Threads  pure; any.
/// Library  meshoptimizer.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>
#include <vector>

namespace frustumscreen::bake {

/// For each position, a number that equal positions share; numbers begin at 0, without gaps.
[[nodiscard]] std::vector<std::uint32_t> numbers_of_places(const SourceMesh& mesh);

/// The share of the area, 0 to 0.5: in each connected part, the triangles on the side with less area.
[[nodiscard]] double inside_out_share(const SourceMesh& mesh);

} // namespace frustumscreen::bake
