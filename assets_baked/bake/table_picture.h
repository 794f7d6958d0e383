/// A small picture of the artifact for the table, where it lies among others: seen from before, from one side and
/// from above, in the pack's own light, cut out.
///
/// Shape    the longer side has `table_picture_px`, with an empty texel all around.
/// Colour   sRGB, not premultiplied; alpha is the share of a texel that the artifact covers. Beyond the outline the
///          colours go on, so that a filter finds no fringe. The brightest places are as bright as the exhibit shows
///          them (app/scene/exposure.h).
/// Threads  uses all cores; deterministic.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack.h"

namespace frustumscreen {

inline constexpr int table_picture_px = 256;

/// Of the default level. Empty if it has no surface.
[[nodiscard]] Image8 make_table_picture(const Pack& pack);

} // namespace frustumscreen
