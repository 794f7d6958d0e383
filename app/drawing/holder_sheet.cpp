#include "app/drawing/a3_sheet.h"
#include "app/drawing/dimension.h"
#include "app/drawing/drawing.h"
#include "app/drawing/holder.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::drawing {

namespace {

constexpr Pen rim{.stroke = "#000000", .width_mm = 0.35, .fill = "#e0e0e0"};

Extent extent_of(const settings::Polygon& polygon) {
    Extent extent{polygon.front(), polygon.front()};
    for (const glm::dvec2& corner : polygon) {
        extent.include(corner);
    }
    return extent;
}

/// The ends of the line at `y` through a convex polygon.
std::array<double, 2> ends_at(const settings::Polygon& polygon, double y) {
    const Extent extent = extent_of(polygon);
    std::array<double, 2> ends{extent.high.x, extent.low.x};
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec2& a = polygon[k];
        const glm::dvec2& b = polygon[(k + 1) % polygon.size()];
        if ((a.y <= y) != (b.y <= y)) {
            const double x = glm::mix(a.x, b.x, (y - a.y) / (b.y - a.y));
            ends = {std::min(ends[0], x), std::max(ends[1], x)};
        }
    }
    return ends;
}

glm::dvec2 middle_of(const settings::Polygon& polygon) {
    const Extent extent = extent_of(polygon);
    return 0.5 * (extent.low + extent.high);
}

double section_y(const Holder& holder) {
    return middle_of(holder.pocket).y;
}

void draw_above(SvgSheet& sheet, const Holder& holder, double mm_per_m) {
    const Extent extent = extent_of(holder.plate);
    const glm::dvec2 middle_m = 0.5 * (extent.low + extent.high);
    const View view{glm::dvec2(114.0, 150.0) - mm_per_m * glm::dvec2(middle_m.x, -middle_m.y), mm_per_m};
    sheet.text({16.0, 18.0}, "From above", heading);
    sheet.begin_view("above", view.origin_mm, view.mm_per_m);
    sheet.polygon(view(holder.plate), rim, "plate");
    sheet.polygon(view(holder.pocket), {.stroke = "#000000", .width_mm = 0.5, .fill = "#ffffff"}, "pocket");
    sheet.end_view();
    sheet.circle(view(glm::dvec2(0.0)), 1.0, {.stroke = "#a02020", .width_mm = 0.5, .fill = "#ffe0e0"});
    const double y = section_y(holder);
    const glm::dvec2 left = view({extent.low.x, y}) - glm::dvec2(6.0, 0.0);
    const glm::dvec2 right = view({extent.high.x, y}) + glm::dvec2(6.0, 0.0);
    sheet.line(left, right, {.stroke = "#444444", .width_mm = 0.25, .fill = "none", .dashes = "6 1.5 1 1.5"});
    sheet.text(left + glm::dvec2(-2.0, 1.3), "A", {.height_mm = 4.0, .anchor = TextAnchor::End});
    sheet.text(right + glm::dvec2(2.0, 1.3), "A", {.height_mm = 4.0});
    const glm::dvec2 inside_mm = view(middle_of(holder.pocket));
    for (std::size_t k = 0; k < holder.pocket.size(); ++k) {
        const glm::dvec2 corner_mm = view(holder.pocket[k]);
        sheet.text(corner_mm + 6.0 * glm::normalize(inside_mm - corner_mm) + glm::dvec2(0.0, 1.0),
                   fmt::format("{}", k + 1), {.height_mm = 2.8, .anchor = TextAnchor::Middle});
    }
    draw_dimension(sheet, view(extent.low), view({extent.high.x, extent.low.y}), {0.0, 10.0},
                   mm_words(extent.high.x - extent.low.x));
    draw_dimension(sheet, view({extent.high.x, extent.low.y}), view(extent.high), {14.0, 0.0},
                   mm_words(extent.high.y - extent.low.y));
}

/// Along A, with the prop behind it.
void draw_section(SvgSheet& sheet, const settings::Polygon& prop_front, const Holder& holder,
                  double mm_per_m) {
    const double y = section_y(holder);
    const auto [left, right] = ends_at(holder.plate, y);
    const auto [inner_left, inner_right] = ends_at(holder.pocket, y);
    const View view{{310.0 - 0.5 * mm_per_m * (left + right), 26.0 + mm_per_m * extent_of(prop_front).high.y},
                    mm_per_m};
    const auto part = [&](double x0, double x1, double z0, double z1, std::string_view name) {
        const std::array<glm::dvec2, 4> corners{{{x0, z0}, {x1, z0}, {x1, z1}, {x0, z1}}};
        sheet.polygon(view(corners), rim, name);
    };
    sheet.text({225.0, 18.0}, "Section A - A, with the prop", heading);
    sheet.begin_view("section", view.origin_mm, view.mm_per_m);
    sheet.polygon(view(prop_front), hidden, "prop");
    part(left, right, -holder.plate_m, 0.0, "plate");
    part(left, inner_left, 0.0, holder.rim_m, "left rim");
    part(inner_right, right, 0.0, holder.rim_m, "right rim");
    sheet.end_view();
    draw_dimension(sheet, view({left, -holder.plate_m}), view({right, -holder.plate_m}), {0.0, 8.0},
                   mm_words(right - left));
}

void draw_corners(SvgSheet& sheet, const Holder& holder) {
    constexpr std::size_t rows = 7;
    sheet.text({225.0, 166.0}, "The pocket's corners: x, y from the red dot", heading);
    for (std::size_t k = 0; k < holder.pocket.size(); ++k) {
        const glm::dvec2& corner = holder.pocket[k];
        const std::size_t column = k / rows;
        sheet.text({225.0 + 55.0 * static_cast<double>(column), 174.0 + 5.0 * static_cast<double>(k % rows)},
                   fmt::format("{}: {}, {}", k + 1, mm_words(corner.x), mm_words(corner.y)), {3.0});
    }
}

void draw_notes(SvgSheet& sheet, const Holder& holder, const View& view) {
    const std::string lines[] = {
        fmt::format("Scale {}.", scale_words(view)),
        fmt::format("Plate {} thick; rim {} wide, {} high above the plate.", mm_words(holder.plate_m),
                    mm_words(holder_rim_width_m), mm_words(holder.rim_m)),
        fmt::format("The pocket has {} of play on each side of the prop.", mm_words(holder_play_m)),
        "Red dot: the prop's axis, where the zero of the tracker's sensor is in the prop's bottom.",
        "Black, matt: it lies in the projector's light. No metal: it bends the tracker's field."};
    double y_mm = 220.0;
    for (const std::string& line : lines) {
        sheet.text({225.0, y_mm}, line, {2.6});
        y_mm += 5.0;
    }
}

/// The largest standard scale in which both views fit into their fields.
View common_view(const Extent& above, const Extent& section) {
    const View a = fitted_view(above, {0.0, 0.0}, {150.0, 220.0});
    const View b = fitted_view(section, {0.0, 0.0}, {160.0, 110.0});
    return a.mm_per_m < b.mm_per_m ? a : b;
}

} // namespace

std::string holder_sheet(const settings::Settings& settings, std::string_view name) {
    SvgSheet sheet = a3_sheet("Holder", name);
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const Holder holder = holder_for(prop);
    std::vector<glm::dvec2> corners;
    for (const glm::dvec3& corner : prop.corners) {
        corners.emplace_back(corner.x, corner.z);
    }
    const settings::Polygon prop_front = settings::convex_polygon(std::move(corners));
    Extent section = extent_of(holder.plate);
    section.low.y = -holder.plate_m;
    section.high.y = 0.0;
    for (const glm::dvec2& corner : prop_front) {
        section.include(corner);
    }
    const View view = common_view(extent_of(holder.plate), section);
    draw_above(sheet, holder, view.mm_per_m);
    draw_section(sheet, prop_front, holder, view.mm_per_m);
    draw_corners(sheet, holder);
    draw_notes(sheet, holder, view);
    return sheet.take();
}

} // namespace frustumscreen::drawing
