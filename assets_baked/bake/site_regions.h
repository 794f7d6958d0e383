/// Cuts a site (terrain and buildings) into square regions of its ground, each of which becomes a cell (world_cells.h), so that a
/// region that is shown alone has finer levels than the whole.
///
/// Squares   of a quadtree over the ground: 4 x 4 at least. One with more than `max_triangles` is cut into four, down to a 16th of the
///           site's longer side.
/// Cuts      a triangle that crosses a square's edge is cut there. Both sides get the same corners; where one side is cut once more, its
///           corner lies on the other side's edge. So no gap opens beyond rounding.
/// Small     a square with a few triangles is joined with its neighbour of the same four.
/// Frame     squares lie along x and y of the box (box_frame.h); positions stay in the file's frame.
/// Threads   pure; any. Deterministic.
/// Errors    one sentence for the curator: no ground, too few triangles, too many in the smallest square.
#pragma once

#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <cstddef>

namespace frustumscreen::bake {

struct SiteOptions {
    std::size_t max_triangles = 150'000; ///< of a region, if the smallest squares allow it
};
inline constexpr std::size_t min_site_triangles = 2'000;

/// The mesh with a node for each region in place of its own nodes and animations.
[[nodiscard]] Result<SourceMesh> cut_site(SourceMesh mesh, const BoxFrame& frame, const SiteOptions& options);

} // namespace frustumscreen::bake
