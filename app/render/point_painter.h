/// Draws a window's points (scene/window_patches.h) into memory, on the processor, straight into the projector's pixels.
///
/// Colour   sRGB codes; a pixel's samples are averaged in linear light, and a sample without a point counts as black. Alpha is 255
///          where some sample shows a point, otherwise 0.
/// Samples  1 or 2 x 2 a pixel.
/// Threads  one at a time. Allocates only for a larger rectangle than any before.
/// Errors   none: what is behind the eye is not drawn.
#pragma once

#include "app/ldi/point_patch.h"
#include "app/relief/relief_painter.h"
#include "app/relief/sample_light.h"
#include "app/scene/frame_plan.h"

namespace frustumscreen::render {

class PointPainter {
public:
    /// Writes every pixel of the returned rectangle and none outside.
    [[nodiscard]] PixelRectangle paint(const scene::ReliefDraw& drawn,
                                       const relief::PictureSpan<glm::u8vec4>& picture,
                                       const relief::RowLight& light);

private:
    ldi::PointSplatter splatter_;
    relief::SampleLight light_;
};

} // namespace frustumscreen::render
