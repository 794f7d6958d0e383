/// Where the surface that one direction sees ends: along the edges of triangles that face it and have no neighbour that does.
///
/// A grid's lines may miss all of what lies between such an edge and the next line.
/// Frames   the direction's grid, texels.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/grid_crossings.h"

#include <vector>

namespace frustumscreen {

/// Places along all such edges, a quarter of a texel apart, a little inside their triangles; by cells, row by row. Those alone that no
/// other direction sees clearly better.
[[nodiscard]] std::vector<SheetEnd> sheet_ends(const BlockInput& input, const ReliefGrid& grid);

} // namespace frustumscreen
