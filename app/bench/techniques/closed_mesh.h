/// Whether a mesh bounds a solid: then no back of a triangle is ever seen, and a peer may leave backs out.
///
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

namespace frustumscreen {

/// True if every edge is used as often in one direction as in the other (vertices nearer than 1e-6 of the
/// mesh's size count as one), the volume is positive and no material is masked.
[[nodiscard]] bool is_closed(const SourceMesh& mesh);

} // namespace frustumscreen
