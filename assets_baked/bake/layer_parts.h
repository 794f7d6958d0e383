/// Puts what a torch shows, with a mesh's layers, into a pack.
///
/// Errors   a layer with more texels than WebP holds; as pack::put_torches.
/// Threads  uses every core.
#pragma once

#include "app/pack/pack_torches.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/measured_reliefs.h"
#include "firmware_host/base/result.h"

#include <span>

namespace frustumscreen::bake {

/// `layers`: of the mesh, in place of the source's texture, which is the pack's only one. `reliefs`: those of the pack.
[[nodiscard]] Result<void> put_torches(pack::Pack& pack, std::span<const image::Image8> layers,
                                       const ReliefSource& source,
                                       std::span<const pack::MeasuredRelief> reliefs,
                                       const BakeOptions& options);

} // namespace frustumscreen::bake
