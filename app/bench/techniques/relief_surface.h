/// A relief's surface as triangles that a ray cast can use as a source: the reference for the rasterized
/// relief.
///
/// Frame    box.
/// Surface  two triangles per cell, and two per present part of a cut cell, all facing outward; colours from
///          the corners, linear between. Inward sides must not be visible: cast it with front sides alone.
/// Threads  pure; any.
#pragma once

#include "app/relief/block_relief.h"
#include "assets_baked/bake/source_mesh.h"

namespace frustumscreen::bench {

[[nodiscard]] bake::SourceMesh cut_surface_of(const relief::BlockRelief& relief);

} // namespace frustumscreen::bench
