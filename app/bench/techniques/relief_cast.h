/// Layered relief at resolutions that the pack does not hold, made as the bake makes the pack's own: from the finest mesh level, whose
/// triangles are those that somebody sees, turned to who sees them.
///
/// Frame    box.
/// Threads  uses every core.
#pragma once

#include "app/pack/pack_file.h"
#include "app/relief/block_relief.h"

namespace frustumscreen {

/// In the directions of a frustum's faces. `texels` along the longest edge.
[[nodiscard]] BlockRelief blocks_of_pack(const Pack& pack, int texels);

} // namespace frustumscreen
