/// Bakes a region of a site as an artifact of its own (bake.h), without the undersides that its cuts lay open.
///
/// Frame, errors, threads   as bake.h.
#pragma once

#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/site_curtains.h"

#include <span>

namespace frustumscreen::bake {

/// `curtains`: what hides undersides from visitors (site_curtains.h), in the mesh's own frame. A mesh with cut-outs keeps its undersides.
[[nodiscard]] Result<pack::Pack> bake_region(const SourceMesh& mesh, const BakeOptions& options,
                                             std::span<const CurtainTriangle> curtains);

} // namespace frustumscreen::bake
