/// Layered relief at resolutions that the pack does not contain, made with the bake's method: from the finest
/// mesh level, whose triangles are those visible from outside, turned to the viewer.
///
/// Frame    box.
/// Threads  uses every core.
#pragma once

#include "app/pack/pack_file.h"
#include "app/relief/block_relief.h"

namespace frustumscreen::bench {

/// In the directions of a frustum's faces. `texels` along the longest edge.
[[nodiscard]] relief::BlockRelief blocks_of_pack(const pack::Pack& pack, int texels);

} // namespace frustumscreen::bench
