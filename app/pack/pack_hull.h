/// The convex solid that holds an artifact, by its corners: a pack's section `hull` (FORMAT.md). Who sees all of the solid sees all
/// of the artifact.
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

namespace frustumscreen {

/// As many as the bake keeps.
inline constexpr std::size_t most_hull_corners = 1024;

/// The pack must not have it yet.
void put_hull(const std::vector<glm::dvec3>& corners, PackDescription& pack);
/// Of a pack without the section, from an earlier bake: the corners of its box.
[[nodiscard]] Result<std::vector<glm::dvec3>> hull_of(const PackDescription& pack);

/// The same as it stands in a prop, with at most `most` corners.
[[nodiscard]] Result<std::vector<glm::dvec3>> hull_in(const PackDescription& pack, const PropShape& prop,
                                                      std::size_t most = most_hull_corners);

} // namespace frustumscreen
