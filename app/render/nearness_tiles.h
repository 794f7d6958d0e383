/// The tiles of a rasterized relief that a torch may light: what a tile shows lies between its least and its greatest nearness.
///
/// Threads  pure; any. Allocates nothing.
#pragma once

#include "app/relief/relief_painter.h"
#include "app/scene/frame_plan.h"

namespace frustumscreen::render {

/// Lights those tiles of a part of the picture. `nearness`: of the whole picture (relief/nearness_row.h). Returns the rectangle around
/// their places in the torch's own picture: all of it whose depth is asked for.
PixelRectangle light_tiles(const scene::FramePlan& plan, const scene::TorchFace& face,
                           const PixelRectangle& part, const relief::PictureSpan<const float>& nearness,
                           scene::LitTiles& tiles);

} // namespace frustumscreen::render
