/// Whether a mesh bounds a solid: then no back of a triangle is ever visible, and a peer may cull back faces.
///
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

namespace frustumscreen::bench {

/// True if every edge is used equally often in both directions (vertices closer than 1e-6 of the mesh's size
/// count as one), the volume is positive and no material is masked.
[[nodiscard]] bool is_closed(const bake::SourceMesh& mesh);

} // namespace frustumscreen::bench
