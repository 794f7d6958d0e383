/// Dimensions of a technical drawing: extension lines, arrows, and the measure next to them.
///
/// Frame    paper, millimetres.
/// Threads  as SvgSheet.
#pragma once

#include "app/drawing/svg_sheet.h"

#include <string_view>

namespace frustumscreen::drawing {

/// Dimensions the distance from `from` to `to`, at the offset `off` from both; `off` is perpendicular to the
/// line between them. The words are above the line; if they do not fit between the arrows, they follow `to`,
/// and the arrows are outside.
void draw_dimension(SvgSheet& sheet, const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& off,
                    std::string_view words);

/// Dimensions the angle at `vertex` between the directions to `from` and to `to`, less than 180 degrees; the
/// words are inside it.
void draw_angle(SvgSheet& sheet, const glm::dvec2& vertex, const glm::dvec2& from, const glm::dvec2& to,
                double radius_mm);

} // namespace frustumscreen::drawing
