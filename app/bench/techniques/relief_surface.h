/// A relief's surface as triangles that a ray cast can take for a source: what a cast of the relief must show.
///
/// Frame    box.
/// Surface  two triangles a cell, and two a part of a cut cell that is there, all turned outward; colours as the corners have them,
///          linear between. Of sides that look inward nothing is shown: cast it at front sides alone.
/// Threads  pure; any.
#pragma once

#include "app/relief/block_relief.h"
#include "assets_baked/bake/source_mesh.h"

namespace frustumscreen {

[[nodiscard]] SourceMesh cut_surface_of(const BlockRelief& relief);

} // namespace frustumscreen
