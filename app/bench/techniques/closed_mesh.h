/// Whether a mesh bounds a solid: then no back of a triangle is ever seen, and a peer may leave backs out.
///
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

namespace frustumscreen {

/// Every edge is run through as often one way as the other (vertices nearer than 1e-6 of the mesh's size
/// count as one), the volume is positive and no material is masked.
[[nodiscard]] bool is_closed(const SourceMesh& mesh);

} // namespace frustumscreen
