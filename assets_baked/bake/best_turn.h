/// Chooses a turn of an artifact about its vertical axis, so that it shows most in the prop.
///
/// The prop is square: the size depends only on the turn within a quarter. The artifact is not turned if that
/// gives the largest possible size, within 0.5 %; otherwise it is turned by 45 degrees if that does;
/// otherwise by the whole number of degrees at which it is largest. Among the four sides that can then face the
/// visitor, the file's own front is chosen, unless the adjacent sides cover clearly more, 10 %. So a round
/// artifact is not turned, a chest stands straight, and a blade shows its broad side.
///
/// Frame    the turn is counter-clockwise seen from above; the visitor looks along +Y.
/// Threads  uses all cores; deterministic.
#pragma once

#include "app/geometry/prop_shape.h"
#include "assets_baked/bake/source_mesh.h"

#include <string_view>

namespace frustumscreen::bake {

/// -44 to 135. `prop` must look the same after a quarter turn. 0 for an unknown up axis or a mesh without
/// extent.
[[nodiscard]] double best_turn_deg(const SourceMesh& mesh, std::string_view up, double lift,
                                   const geometry::PropShape& prop);

} // namespace frustumscreen::bake
