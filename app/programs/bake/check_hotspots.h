/// Looks at a scan's hotspots before the work on texts and levels.
///
/// Errors   as assets_baked/bake/hotspots.h.
/// Threads  one caller.
#pragma once

#include "assets_baked/bake/bake.h"

namespace frustumscreen {

/// With the options that the bake will have, so that what passes here passes there.
[[nodiscard]] Result<void> check_hotspots(const SourceMesh& mesh, const BakeOptions& options);

} // namespace frustumscreen
