/// The frame that marks a region on a site's miniature: thin bars along the upper edges of the region's box, on four posts.
///
/// Frame    its own box: a cube of edge 1 that stands on z = 0.
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/scene/frame_plan.h"
#include "app/scene/level_data.h"
#include "app/world/site_view.h"

#include <cstdint>
#include <memory>

namespace frustumscreen::residency {

struct SiteMark {
    scene::LevelData data; ///< to upload
    std::shared_ptr<const scene::LevelTriangles> triangles;
    std::uint64_t planned_gpu_bytes = 0;
};
[[nodiscard]] SiteMark make_site_mark();

/// `mark`: with its triangles and drawable.
[[nodiscard]] scene::PlacedLevel placed_mark(const scene::PlacedLevel& mark, const world::RegionBox& region,
                                             double metres_per_box);

} // namespace frustumscreen::residency
