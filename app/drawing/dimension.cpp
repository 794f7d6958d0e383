#include "app/drawing/dimension.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::drawing {

namespace {

constexpr Pen thin{"#444444", 0.13};
constexpr double arrow_mm = 2.2;
constexpr double letters_mm = 2.8;
constexpr double gap_mm = 1.0;       ///< between the object and its extension line
constexpr double overshoot_mm = 1.2; ///< of the extension line beyond the arrow

void draw_arrow(SvgSheet& sheet, const glm::dvec2& tip, const glm::dvec2& pointing) {
    const glm::dvec2 side(-pointing.y, pointing.x);
    const glm::dvec2 back = tip - arrow_mm * pointing;
    const std::array<glm::dvec2, 3> corners{tip, back + 0.17 * arrow_mm * side,
                                            back - 0.17 * arrow_mm * side};
    sheet.polygon(corners, {.stroke = "none", .width_mm = 0.0, .fill = "#444444"});
}

void draw_extension(SvgSheet& sheet, const glm::dvec2& from, const glm::dvec2& off) {
    const double length = glm::length(off);
    if (length > gap_mm) {
        const glm::dvec2 along = off / length;
        sheet.line(from + gap_mm * along, from + off + overshoot_mm * along, thin);
    }
}

} // namespace

void draw_dimension(SvgSheet& sheet, const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& off,
                    std::string_view words) {
    const double length = glm::distance(from, to);
    const glm::dvec2 along = (to - from) / length;
    draw_extension(sheet, from, off);
    draw_extension(sheet, to, off);
    const glm::dvec2 begin = from + off;
    const glm::dvec2 end = to + off;
    const bool fits = length >= length_mm(words, letters_mm) + 2.0 * arrow_mm + 1.0;
    const double outside = fits ? 0.0 : 2.0 * arrow_mm;
    draw_arrow(sheet, begin, fits ? -along : along);
    draw_arrow(sheet, end, fits ? along : -along);
    const double tail = fits ? 0.0 : outside + length_mm(words, letters_mm);
    sheet.line(begin - outside * along, end + tail * along, thin);
    // Words are read from below or from the right, and stand above their line in that direction.
    double turned_deg = glm::degrees(std::atan2(along.y, along.x));
    constexpr double just_off = 1e-6;
    const bool backwards = turned_deg > 90.0 - just_off || turned_deg <= -90.0 - just_off;
    turned_deg += backwards ? 180.0 : 0.0;
    const double radians = glm::radians(turned_deg);
    const glm::dvec2 above(std::sin(radians), -std::cos(radians));
    const glm::dvec2 at = fits ? 0.5 * (begin + end) : end + (0.5 * (outside + tail)) * along;
    sheet.text(at + 0.8 * above, words,
               {.height_mm = letters_mm, .anchor = TextAnchor::Middle, .turned_deg = turned_deg});
}

void draw_angle(SvgSheet& sheet, const glm::dvec2& vertex, const glm::dvec2& from, const glm::dvec2& to,
                double radius_mm) {
    const glm::dvec2 a = glm::normalize(from - vertex);
    const glm::dvec2 b = glm::normalize(to - vertex);
    const double start = std::atan2(a.y, a.x);
    const double turn = std::remainder(std::atan2(b.y, b.x) - start, 2.0 * std::numbers::pi);
    const auto at = [&](double share, double radius) {
        return vertex + radius * glm::dvec2(std::cos(start + share * turn), std::sin(start + share * turn));
    };
    constexpr int pieces = 16;
    for (int k = 0; k < pieces; ++k) {
        sheet.line(at(1.0 * k / pieces, radius_mm), at((k + 1.0) / pieces, radius_mm), thin);
    }
    const std::string words = fmt::format("{:.1f}\u00b0", glm::degrees(std::abs(turn)));
    const double reach = radius_mm + 1.0 + 0.5 * length_mm(words, letters_mm);
    sheet.text(at(0.5, reach) + glm::dvec2(0.0, 0.35 * letters_mm), words, {letters_mm, TextAnchor::Middle});
}

} // namespace frustumscreen::drawing
