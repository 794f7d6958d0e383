/// The parts of a rasterized relief that lie in a torch's beam, and the tiles of the torch's own picture that their shadows need.
///
/// Threads  pure; any. Allocates nothing once `rectangles` has the capacity.
/// SIMD     as relief/rasterize_blocks.h.
#pragma once

#include "app/relief/instructions.h"
#include "app/relief/picture_span.h"
#include "app/relief/tile_mask.h"
#include "app/scene/frame_plan.h"

#include <vector>

namespace frustumscreen::render {

struct LitParts {
    std::vector<PixelRectangle> rectangles; ///< disjoint; around all pixels in the beam, in groups of 8 x 8
    relief::TileMask asked;                 ///< tiles of the torch's own picture whose depths they need
};

/// Adds those of a part of the picture. `nearness`: of the whole picture (relief/nearness_row.h), at least 8 pixels wide.
void add_lit(const scene::FramePlan& plan, const scene::TorchFace& face, const PixelRectangle& part,
             const relief::PictureSpan<const float>& nearness, LitParts& lit,
             relief::Instructions instructions = relief::best_instructions());

} // namespace frustumscreen::render
