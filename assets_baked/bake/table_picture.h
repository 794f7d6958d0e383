/// A small picture of the artifact for the table, where it appears among others: seen from the front, one
/// side and above, in the pack's own light, cut out.
///
/// Shape    the longer side has `table_picture_px` texels, with an empty texel all around.
/// Colour   sRGB, not premultiplied; alpha is the share of a texel that the artifact covers. The colours
///          continue beyond the outline, so that filtering makes no fringe. The brightest places are as
///          bright as in the exhibit (app/scene/exposure.h).
/// Threads  uses all cores; deterministic.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack.h"

namespace frustumscreen::bake {

inline constexpr int table_picture_px = 256;

/// A picture of the default level; empty if it has no surface.
[[nodiscard]] image::Image8 make_table_picture(const pack::Pack& pack);

} // namespace frustumscreen::bake
