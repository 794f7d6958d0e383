/// The ends of the surface that one direction sees: along edges of triangles that face it, without a
/// neighbour that does.
///
/// A grid's lines may miss everything between such an edge and the next line.
/// Frames   the direction's grid, texels.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/cross_grid.h"

#include <vector>

namespace frustumscreen::bake {

/// Points along these edges, a quarter of a texel apart, slightly inside their triangles, sorted by cells,
/// row by row. Only points that no other direction sees clearly better.
[[nodiscard]] std::vector<relief::SheetEnd> sheet_ends(const BlockInput& input,
                                                       const relief::ReliefGrid& grid);

} // namespace frustumscreen::bake
