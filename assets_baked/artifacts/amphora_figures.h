/// The amphora's figures, in silhouette with incised lines, as Attic black-figure painters drew them.
///
/// Units    p: figure heights, feet at y = 0, walking towards +x; `edge` is the width of a texel in the same
///          units.
/// Threads  pure; any.
#pragma once

#include "assets_baked/artifacts/ink.h"

namespace frustumscreen::artifacts {

inline constexpr int shield_emblems = 4;

/// A striding warrior with crested helmet, round shield and raised spear; about 0.9 wide.
void paint_hoplite(Ink& ink, glm::vec2 p, int emblem, float edge);
/// A grazing or a looking deer, about 1.5 wide.
void paint_deer(Ink& ink, glm::vec2 p, bool grazing, float edge);
/// Palmettes and spirals below a handle; symmetric, about 0.8 wide.
void paint_handle_ornament(Ink& ink, glm::vec2 p, float edge);

} // namespace frustumscreen::artifacts
