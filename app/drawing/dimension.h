/// Dimensions of a technical drawing: extension lines, arrows, and the measure beside them.
///
/// Frame    paper, millimetres.
/// Threads  as SvgSheet.
#pragma once

#include "app/drawing/svg_sheet.h"

#include <string_view>

namespace frustumscreen {

/// Of the distance from `from` to `to`, `off` away from both; `off` is square to the line between them. The words stand above
/// the line; where they have no room between the arrows, they stand behind `to`, and the arrows outside.
void draw_dimension(SvgSheet& sheet, const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& off,
                    std::string_view words);

/// Of the angle at `vertex` between the directions to `from` and to `to`, less than 180 degrees; the words stand inside it.
void draw_angle(SvgSheet& sheet, const glm::dvec2& vertex, const glm::dvec2& from, const glm::dvec2& to,
                double radius_mm);

} // namespace frustumscreen
