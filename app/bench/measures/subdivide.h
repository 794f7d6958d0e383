/// A mesh with more triangles and an unchanged surface.
///
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

namespace frustumscreen::bench {

/// Splits each triangle into four at the middles of its edges; attributes at a middle are the mean of the
/// edge's ends.
[[nodiscard]] bake::SourceMesh subdivide(const bake::SourceMesh& mesh);

} // namespace frustumscreen::bench
