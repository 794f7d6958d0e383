/// Parts of a surface that share no triangle and no corner with each other: what cells are made of where the file gives
/// none. A cut between them opens no crack, since no triangle lies on both sides of it, and doubles no edge.
///
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/source_mesh.h"
#include "assets_baked/bake/visibility.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen::bake {

struct SurfaceParts {
    std::vector<std::uint32_t> part_of; ///< of each triangle, numbered from 0
    std::size_t count = 0;
};

/// Triangles are of one part if corners at equal positions connect them.
[[nodiscard]] SurfaceParts connected_surfaces(const SourceMesh& mesh);

/// Joins connected surfaces to at most `max_parts` parts, the largest first. In a file with nodes, surfaces of one node are
/// one part, and so are nodes that share a surface. A part with less than `min_share` of the area belongs to the nearest
/// larger one, by their boxes; of those that it touches or overlaps, to the smallest.
[[nodiscard]] SurfaceParts find_parts(const SourceMesh& mesh, double min_share, std::size_t max_parts);

/// The mesh with a node for each part in place of its own nodes, without animations. Triangles that no eye of the zone
/// sees are left out: another part hides them. `frame`: of the mesh.
[[nodiscard]] SourceMesh with_parts(SourceMesh mesh, const SurfaceParts& parts, const BoxFrame& frame,
                                    const ViewingZone& zone);

} // namespace frustumscreen::bake
