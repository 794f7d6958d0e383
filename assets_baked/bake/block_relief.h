/// Bakes a surface into relief blocks: every front-facing crossing of the grid lines in the directions of the
/// prop's faces, linked into cells. The direction that sees a crossing best keeps it; others keep a rim
/// around it.
///
/// Frame    box.
/// Threads  uses every core; the result does not depend on their number.
/// Source   layered depth images (Shade 1998) in the directions of a prop's faces (Kim 2008), with their
///          holes closed.
#pragma once

#include "app/relief/block_relief.h"
#include "assets_baked/bake/direction_frame.h"
#include "assets_baked/bake/source_scene.h"

namespace frustumscreen::bake {

struct BlockInput {
    const SourceScene& surface; ///< only front sides are kept; invisible parts should be removed beforehand
    glm::dvec3 box_size{1.0};
    std::vector<pack::ReliefDirection> directions;
    int texels = 512; ///< along the box's longest edge
};

[[nodiscard]] relief::BlockRelief bake_blocks(const BlockInput& input);

} // namespace frustumscreen::bake
