#include "app/drawing/solid_views.h"

#include "app/drawing/a3_sheet.h"
#include "app/drawing/dimension.h"
#include "app/settings/polygon.h"

#include <cmath>
#include <string>
#include <vector>

namespace frustumscreen::drawing {

namespace {

/// A parallel projection along `from`, the direction to who looks.
struct Side {
    std::string heading;
    std::string name; ///< in the file
    glm::dvec3 from, right, up;

    [[nodiscard]] glm::dvec2 operator()(const glm::dvec3& p) const {
        return {glm::dot(p, right), glm::dot(p, up)};
    }
};

const std::vector<Side>& sides() {
    static const std::vector<Side> all{
        {"From the front", "front", {0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
        {"From above", "above", {0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
        {"From the right", "right", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    };
    return all;
}

Extent extent_of(const geometry::PropShape& prop, const Side& side) {
    Extent extent{side(prop.corners.front()), side(prop.corners.front())};
    for (const glm::dvec3& corner : prop.corners) {
        extent.include(side(corner));
    }
    return extent;
}

void draw_view(SvgSheet& sheet, const geometry::PropShape& prop, const Side& side, const View& view) {
    sheet.begin_view(side.name, view.origin_mm, view.mm_per_m);
    for (const geometry::PropFace& face : prop.faces) {
        constexpr double edge_on = 1e-6;
        if (glm::dot(face.plane.normal, side.from) > edge_on) {
            std::vector<glm::dvec2> seen;
            for (const glm::dvec3& corner : face.corners) {
                seen.push_back(side(corner));
            }
            sheet.polygon(view(seen), fine, face.name);
        }
    }
    std::vector<glm::dvec2> points;
    for (const glm::dvec3& corner : prop.corners) {
        points.push_back(side(corner));
    }
    sheet.polygon(view(settings::convex_polygon(std::move(points))), outline, side.name);
    sheet.circle(view(glm::dvec2(0.0)), 1.0, {.stroke = "#a02020", .width_mm = 0.5, .fill = "#ffe0e0"});
    sheet.end_view();
    const Extent extent = extent_of(prop, side);
    draw_dimension(sheet, view(extent.low), view({extent.high.x, extent.low.y}), {0.0, 8.0},
                   mm_words(extent.high.x - extent.low.x));
    draw_dimension(sheet, view({extent.high.x, extent.low.y}), view(extent.high), {8.0, 0.0},
                   mm_words(extent.high.y - extent.low.y));
}

} // namespace

View draw_solid_views(SvgSheet& sheet, const geometry::PropShape& prop) {
    constexpr double top_mm = 18.0;
    constexpr double around_mm = 27.0; // heading and dimensions of each view
    constexpr double middle_mm = 105.0;
    glm::dvec2 size_m(0.0); // of all three, one below the other
    for (const Side& side : sides()) {
        const Extent extent = extent_of(prop, side);
        size_m = {std::fmax(size_m.x, extent.high.x - extent.low.x), size_m.y + extent.high.y - extent.low.y};
    }
    const double height_mm = 262.0 - around_mm * static_cast<double>(sides().size());
    const double mm_per_m = fitted_view({glm::dvec2(0.0), size_m}, {0.0, 0.0}, {140.0, height_mm}).mm_per_m;
    double heading_mm = top_mm;
    for (const Side& side : sides()) {
        const Extent extent = extent_of(prop, side);
        const double high_mm = mm_per_m * (extent.high.y - extent.low.y);
        sheet.text({16.0, heading_mm}, side.heading, heading);
        draw_view(sheet, prop, side,
                  {{middle_mm - 0.5 * mm_per_m * (extent.low.x + extent.high.x),
                    heading_mm + 4.0 + high_mm + mm_per_m * extent.low.y},
                   mm_per_m});
        heading_mm += around_mm + high_mm;
    }
    return {{middle_mm, 0.0}, mm_per_m};
}

} // namespace frustumscreen::drawing
