/// The convex hull of an artifact, by its corners: a pack's section `hull` (FORMAT.md). An eye that sees all of the
/// hull sees all of the artifact.
///
/// Frame    box; box units. In a prop: prop P, metres.
/// Errors   one line beginning with the field's place in the manifest.
/// Threads  values; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <vector>

namespace frustumscreen::pack {

/// The bake keeps at most this number of corners.
inline constexpr std::size_t max_hull_corners = 1024;

/// The pack must not have the section yet.
void put_hull(const std::vector<glm::dvec3>& corners, PackDescription& pack);
/// The eight corners of its box.
[[nodiscard]] std::vector<glm::dvec3> corners_of_box(const PackDescription& pack);
/// The hull's corners; those of the box if a pack of an earlier bake lacks the section.
[[nodiscard]] Result<std::vector<glm::dvec3>> hull_of(const PackDescription& pack);

/// The hull in a prop, with at most `most` corners.
[[nodiscard]] Result<std::vector<glm::dvec3>>
hull_in(const PackDescription& pack, const geometry::PropShape& prop, std::size_t most = max_hull_corners);

} // namespace frustumscreen::pack
