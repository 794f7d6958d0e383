/// Checks a scan's hotspots before texts and levels are made.
///
/// Errors   as assets_baked/bake/hotspots.h.
/// Threads  one caller.
#pragma once

#include "assets_baked/bake/bake.h"

namespace frustumscreen::programs {

/// Checks with the bake's options, so that hotspots which pass here pass the bake.
[[nodiscard]] Result<void> check_hotspots(const bake::SourceMesh& mesh, const bake::BakeOptions& options);

} // namespace frustumscreen::programs
