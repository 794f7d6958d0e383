/// How an artifact is turned about its vertical axis, so that it shows most in the prop.
///
/// The prop is square: size depends on the turn within a quarter only. The artifact is not turned if it is as large
/// so as fits, within 0.5 %; else by 45 degrees if that is; else by the whole degrees at which it is largest. Of the
/// four sides that can then look at the visitor the file's own front does, unless the sides beside it cover clearly
/// more, 10 %. So a round artifact is not turned, a chest stands straight, and a blade shows its broad side.
///
/// Frame    the turn is counter-clockwise seen from above; the visitor looks along +Y.
/// Threads  uses all cores; deterministic.
#pragma once

#include "app/geometry/prop_shape.h"
#include "assets_baked/bake/source_mesh.h"

#include <string_view>

namespace frustumscreen {

/// -45 to 135. `prop` looks the same after a quarter turn. 0 for an unknown up axis or a mesh without extent.
[[nodiscard]] double best_turn_deg(const SourceMesh& mesh, std::string_view up, double lift,
                                   const PropShape& prop);

} // namespace frustumscreen
