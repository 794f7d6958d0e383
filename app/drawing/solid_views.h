/// A prop of any shape, seen from the front, from above and from the right, one view below the other.
///
/// Frame    paper, millimetres; the views' own in metres.
/// Threads  as SvgSheet.
#pragma once

#include "app/drawing/svg_sheet.h"
#include "app/geometry/prop_shape.h"

namespace frustumscreen::drawing {

/// Returns the views' scale.
[[nodiscard]] View draw_solid_views(SvgSheet& sheet, const geometry::PropShape& prop);

} // namespace frustumscreen::drawing
