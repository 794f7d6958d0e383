/// Triangles whose corners run the other way round than those of their neighbours, so that their outside is within.
///
/// Shape    neighbours share an edge, by equal positions; edges of more than two triangles connect nothing. A part that
///          runs the other way round as a whole does not count: a bake takes the side that visitors see.
/// Threads  pure; any.
/// Library  meshoptimizer.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen::bake {

/// For each position, a number that equal positions share; numbers begin at 0, without gaps.
[[nodiscard]] std::vector<std::uint32_t> numbers_of_places(const SourceMesh& mesh);

/// The share of the area, 0 to 0.5: in each connected part, the triangles on the side with less area.
[[nodiscard]] double inside_out_share(const SourceMesh& mesh);

/// Turns the triangles of closed parts so that their fronts are outside; returns how many it turned. A part is closed if each
/// edge has two triangles and it has two sides; open parts stay as they are. In a closed part within the extents of another,
/// which may be the wall of a hollow, the side with more area decides, and in one without volume too.
std::size_t turn_outward(SourceMesh& mesh);

} // namespace frustumscreen::bake
