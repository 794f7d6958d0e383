/// Common parts of the A3 sheets: frame, title block, pens.
///
/// Frame    paper, millimetres.
/// Threads  as SvgSheet.
#pragma once

#include "app/drawing/svg_sheet.h"

#include <fmt/format.h>

#include <string_view>

namespace frustumscreen::drawing {

inline constexpr glm::dvec2 a3_mm{420.0, 297.0};
inline constexpr Pen outline{"#000000", 0.5};
inline constexpr Pen fine{"#444444", 0.13};
inline constexpr Pen hidden{.stroke = "#444444", .width_mm = 0.25, .fill = "none", .dashes = "2 1"};
inline constexpr Lettering heading{
    .height_mm = 4.0, .anchor = TextAnchor::Start, .turned_deg = 0.0, .bold = true};

/// `title` names the drawing, `name` the settings.
inline SvgSheet a3_sheet(std::string_view title, std::string_view name) {
    constexpr double margin_mm = 10.0;
    constexpr glm::dvec2 low(margin_mm);
    constexpr glm::dvec2 high = a3_mm - margin_mm;
    constexpr glm::dvec2 field(265.0, 265.0); // its top left corner
    SvgSheet sheet(a3_mm);
    const glm::dvec2 corners[] = {low, {high.x, low.y}, high, {low.x, high.y}};
    sheet.polygon(corners, {"#000000", 0.7});
    sheet.line(field, {high.x, field.y}, {"#000000", 0.35});
    sheet.line(field, {field.x, high.y}, {"#000000", 0.35});
    sheet.text(field + glm::dvec2(4.0, 7.5), title,
               {.height_mm = 4.5, .anchor = TextAnchor::Start, .turned_deg = 0.0, .bold = true});
    sheet.text(field + glm::dvec2(4.0, 13.0), fmt::format("of the settings {}", name));
    sheet.text(field + glm::dvec2(4.0, 18.0), "All lengths in mm.");
    return sheet;
}

} // namespace frustumscreen::drawing
