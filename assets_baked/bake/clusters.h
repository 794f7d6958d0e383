/// Cuts triangles into clusters that are culled as a whole, for the pack's levels and for the bench's peers.
///
/// Frame    that of the positions, normalised to the object: the margin of spheres and cones for 32-bit
///          rounding assumes a longest edge of 1.
/// Threads  pure; any.
/// Library  meshoptimizer (meshlets and their normal cones).
#pragma once

#include "app/pack/pack.h"

#include <span>
#include <vector>

namespace frustumscreen::bake {

/// Reorders the triangles of `indices` cluster by cluster, each in vertex-cache order, and computes the
/// bounds of every cluster; the first one's `first_index` is `first_index`.
[[nodiscard]] std::vector<pack::PackCluster> cut_into_clusters(std::span<std::uint32_t> indices,
                                                               std::span<const glm::vec3> positions,
                                                               std::uint32_t first_index = 0);

} // namespace frustumscreen::bake
