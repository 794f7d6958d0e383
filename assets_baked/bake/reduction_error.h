/// The share of a reduced scan (reduce_scan.h) in errors that are measured against it: a surface lies from the scan at most as
/// far as from the reduced scan, and as that from the scan.
///
/// Frame    box.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "app/pack/seen_errors.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/source_mesh.h"

namespace frustumscreen::bake {

/// Zero for a scan that was not reduced.
[[nodiscard]] pack::LevelError reduction_error(const SourceMesh& mesh, const BoxFrame& frame);

void add_reduction(const pack::LevelError& reduction, pack::LevelError& error);
/// An outline moves at most as far as the surface.
void add_reduction(const pack::LevelError& reduction, pack::SeenErrors& seen);

} // namespace frustumscreen::bake
