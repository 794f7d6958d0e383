#include "app/drawing/a3_sheet.h"
#include "app/drawing/dimension.h"
#include "app/drawing/drawing.h"
#include "app/drawing/prop_net.h"
#include "app/drawing/solid_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

namespace frustumscreen::drawing {

namespace {

constexpr Pen cut{"#000000", 0.35};
constexpr Pen fold{.stroke = "#c02020", .width_mm = 0.25, .fill = "none", .dashes = "3 1.5"};
constexpr Pen glue{.stroke = "#808080", .width_mm = 0.25, .fill = "#f0f0f0"};

/// The prop's three sizes, for a cube or a frustum.
struct Sizes {
    explicit Sizes(const settings::PropSettings& prop)
        : bottom_m(prop.base_m), top_m(prop.kind == settings::PropKind::Cube ? prop.base_m : prop.top_m),
          height_m(prop.kind == settings::PropKind::Cube ? prop.base_m : prop.height_m) {}
    /// From the bottom's edge to the top's, along a side.
    [[nodiscard]] double slant_m() const { return std::hypot(height_m, 0.5 * (bottom_m - top_m)); }
    /// Along the edge between two sides.
    [[nodiscard]] double edge_m() const { return std::hypot(slant_m(), 0.5 * (bottom_m - top_m)); }

    double bottom_m, top_m, height_m;
};

std::vector<glm::dvec2> trapezium(double bottom_m, double top_m, double height_m) {
    return {{-0.5 * bottom_m, 0.0}, {0.5 * bottom_m, 0.0}, {0.5 * top_m, height_m}, {-0.5 * top_m, height_m}};
}

std::vector<glm::dvec2> square(double side_m) {
    const double h = 0.5 * side_m;
    return {{-h, -h}, {h, -h}, {h, h}, {-h, h}};
}

Extent extent_of(const PropNet& net) {
    Extent extent;
    for (const NetFace& face : net.faces) {
        for (const glm::dvec2& corner : face.corners) {
            extent.include(corner);
        }
    }
    for (const NetTab& tab : net.tabs) {
        for (const glm::dvec2& corner : tab.corners) {
            extent.include(corner);
        }
    }
    return extent;
}

/// The numbers are those of the staff picture (app/typography/pattern.h).
std::string_view words_of(std::string_view face) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 6> words{{{"+X", "1, right"},
                                                                                  {"-X", "2, left"},
                                                                                  {"+Y", "3, back"},
                                                                                  {"-Y", "4, front"},
                                                                                  {"+Z", "5, top"},
                                                                                  {"-Z", "6, bottom"}}};
    const auto* const found =
        std::find_if(words.begin(), words.end(), [&](const auto& each) { return each.first == face; });
    return found != words.end() ? found->second : face;
}

/// Largest type size that fits every face.
double lettering_mm(const PropNet& net, const View& view) {
    double shortest_m = std::numeric_limits<double>::infinity();
    for (const NetFace& face : net.faces) {
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            shortest_m = std::fmin(
                shortest_m, glm::distance(face.corners[k], face.corners[(k + 1) % face.corners.size()]));
        }
    }
    constexpr double max_mm = 4.0;
    constexpr double min_mm = 1.2;
    constexpr double letters = 7.0; // per side
    return std::clamp(view.mm_per_m * shortest_m / letters, min_mm, max_mm);
}

void draw_net(SvgSheet& sheet, const PropNet& net, const View& view) {
    sheet.begin_view("net", view.origin_mm, view.mm_per_m);
    for (const NetTab& tab : net.tabs) {
        sheet.polygon(view(tab.corners), glue, "tab");
    }
    for (const NetFace& face : net.faces) {
        sheet.polygon(view(face.corners), cut, face.name);
        const glm::dvec2 middle = std::accumulate(face.corners.begin(), face.corners.end(), glm::dvec2(0.0)) /
                                  static_cast<double>(face.corners.size());
        sheet.text(view(middle), words_of(face.name), {lettering_mm(net, view), TextAnchor::Middle});
    }
    for (const NetFold& each : net.folds) {
        sheet.line(view(each.from), view(each.to), {"#ffffff", 0.5});
        sheet.line(view(each.from), view(each.to), fold);
    }
    sheet.end_view();
}

void draw_front(SvgSheet& sheet, const Sizes& sizes, double heading_mm, const View& view) {
    const std::vector<glm::dvec2> front = trapezium(sizes.bottom_m, sizes.top_m, sizes.height_m);
    sheet.text({16.0, heading_mm}, "From the front", heading);
    sheet.begin_view("front", view.origin_mm, view.mm_per_m);
    sheet.polygon(view(front), outline, "front");
    sheet.end_view();
    draw_dimension(sheet, view(front[0]), view(front[1]), {0.0, 8.0}, mm_words(sizes.bottom_m));
    draw_dimension(sheet, view(front[3]), view(front[2]), {0.0, -7.0}, mm_words(sizes.top_m));
    const glm::dvec2 foot = view(front[1]);
    draw_dimension(sheet, foot, {foot.x, view(front[2]).y}, {8.0, 0.0}, mm_words(sizes.height_m));
    draw_angle(sheet, view(front[0]), view(front[1]), view(front[3]), 9.0);
}

void draw_above(SvgSheet& sheet, const Sizes& sizes, double heading_mm, const View& view) {
    const std::vector<glm::dvec2> bottom = square(sizes.bottom_m);
    const std::vector<glm::dvec2> top = square(sizes.top_m);
    sheet.text({16.0, heading_mm}, "From above", heading);
    sheet.begin_view("above", view.origin_mm, view.mm_per_m);
    sheet.polygon(view(bottom), outline, "bottom");
    for (std::size_t k = 0; k < bottom.size(); ++k) {
        sheet.line(view(bottom[k]), view(top[k]), outline);
    }
    sheet.polygon(view(top), outline, "top");
    sheet.end_view();
    // The sensor's position and axes: those of the prop.
    const double arm_m = std::fmin(0.2 * sizes.bottom_m, 0.5 * sizes.top_m);
    sheet.line(view(glm::dvec2(0.0)), view(glm::dvec2(arm_m, 0.0)), {"#a02020", 0.5});
    sheet.line(view(glm::dvec2(0.0)), view(glm::dvec2(0.0, arm_m)), {"#a02020", 0.5});
    sheet.circle(view(glm::dvec2(0.0)), 1.0, {.stroke = "#a02020", .width_mm = 0.5, .fill = "#ffe0e0"});
    draw_dimension(sheet, view(bottom[0]), view(bottom[1]), {0.0, 8.0}, mm_words(sizes.bottom_m));
}

void draw_side(SvgSheet& sheet, const Sizes& sizes, double heading_mm, const View& view) {
    const std::vector<glm::dvec2> side = trapezium(sizes.bottom_m, sizes.top_m, sizes.slant_m());
    sheet.text({16.0, heading_mm}, "A side (of four)", heading);
    sheet.begin_view("side", view.origin_mm, view.mm_per_m);
    sheet.polygon(view(side), outline, "side");
    sheet.end_view();
    draw_dimension(sheet, view(side[0]), view(side[1]), {0.0, 8.0}, mm_words(sizes.bottom_m));
    draw_dimension(sheet, view(side[3]), view(side[2]), {0.0, -7.0}, mm_words(sizes.top_m));
    const glm::dvec2 foot = view(side[1]);
    draw_dimension(sheet, foot, {foot.x, view(side[2]).y}, {8.0, 0.0}, mm_words(sizes.slant_m()));
    const glm::dvec2 along = glm::normalize(view(side[3]) - view(side[0]));
    draw_dimension(sheet, view(side[0]), view(side[3]), 6.0 * glm::dvec2(along.y, -along.x),
                   mm_words(sizes.edge_m()));
    draw_angle(sheet, view(side[0]), view(side[1]), view(side[3]), 9.0);
}

/// One below the other, all in the largest common scale.
View draw_views(SvgSheet& sheet, const Sizes& sizes) {
    constexpr double top_mm = 18.0;
    constexpr double around_mm = 27.0; // heading and dimensions of each view
    constexpr double height_mm = 262.0 - 3.0 * around_mm;
    constexpr double middle_mm = 105.0;
    const double high_m = sizes.height_m + sizes.bottom_m + sizes.slant_m();
    const double mm_per_m =
        fitted_view({{0.0, 0.0}, {sizes.bottom_m, high_m}}, {0.0, 0.0}, {140.0, height_mm}).mm_per_m;
    const auto at = [&](double y_mm) { return View{{middle_mm, y_mm}, mm_per_m}; };
    double heading_mm = top_mm;
    const auto foot_mm = [&](double view_m) { return heading_mm + 12.0 + mm_per_m * view_m; };
    draw_front(sheet, sizes, heading_mm, at(foot_mm(sizes.height_m)));
    heading_mm += around_mm + mm_per_m * sizes.height_m;
    draw_above(sheet, sizes, heading_mm, at(foot_mm(0.5 * sizes.bottom_m) - 8.0));
    heading_mm += around_mm + mm_per_m * sizes.bottom_m;
    draw_side(sheet, sizes, heading_mm, at(foot_mm(sizes.slant_m())));
    return at(0.0);
}

std::string words_of_lit_faces(const settings::PropSettings& prop) {
    const std::size_t lit = settings::make_prop(prop).faces.size();
    const std::size_t all = settings::make_prop(prop).bounds.size();
    if (prop.kind == settings::PropKind::Frustum) {
        return "The bottom stays open or gets a board; it is never lit.";
    }
    return lit == all ? fmt::format("It is held in the hand: all {} faces are lit.", all)
                      : fmt::format("{} of its {} faces are lit; the net has these alone.", lit, all);
}

void draw_notes(SvgSheet& sheet, const settings::Settings& settings, const View& views, const View& net_view,
                const Extent& net) {
    const std::string lines[] = {
        fmt::format("Scale {}; the net: {}.", scale_words(views), scale_words(net_view)),
        "All sizes are those of the outside, with the paint on.",
        settings.prop.kind == settings::PropKind::Solid
            ? "The faces have the names of the prop's file."
            : "The sides' numbers are those of the staff's picture.",
        "Red, dashed: fold. Black: cut. Grey: tabs for glue.",
        fmt::format("The net with its tabs takes {} x {}.", mm_words(net.high.x - net.low.x),
                    mm_words(net.high.y - net.low.y)),
        words_of_lit_faces(settings.prop),
        "Red dot: the zero of the tracker's sensor, in the middle of the bottom;",
        "red arms: its x, to the right, and y, away from the visitor.",
        "frustumscreen drawing --sheet net draws the net in true size."};
    double y_mm = 220.0;
    for (const std::string& line : lines) {
        sheet.text({269.0, y_mm}, line, {2.6});
        y_mm += 5.0;
    }
}

} // namespace

std::string prop_sheet(const settings::Settings& settings, std::string_view name) {
    SvgSheet sheet = a3_sheet("Prop", name);
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const View views = settings.prop.kind == settings::PropKind::Solid
                           ? draw_solid_views(sheet, prop)
                           : draw_views(sheet, Sizes(settings.prop));
    const PropNet net = unfold(prop);
    const Extent extent = extent_of(net);
    const View net_view = fitted_view(extent, {205.0, 26.0}, {400.0, 206.0});
    sheet.text({205.0, 18.0}, "All faces as one piece, seen from outside", heading);
    draw_net(sheet, net, net_view);
    draw_notes(sheet, settings, views, net_view, extent);
    return sheet.take();
}

std::string net_sheet(const settings::Settings& settings, std::string_view name) {
    constexpr double margin_mm = 12.0;
    constexpr double foot_mm = 18.0; // for the ruler
    constexpr double true_size = 1000.0;
    const PropNet net = unfold(settings::make_prop(settings.prop));
    const Extent extent = extent_of(net);
    const glm::dvec2 size_mm = true_size * (extent.high - extent.low);
    const View view{glm::dvec2(margin_mm) + true_size * glm::dvec2(-extent.low.x, extent.high.y), true_size};
    const glm::dvec2 page_mm(std::fmax(size_mm.x, 180.0) + 2.0 * margin_mm,
                             size_mm.y + 2.0 * margin_mm + foot_mm);
    SvgSheet sheet(page_mm);
    draw_net(sheet, net, view);
    const glm::dvec2 ruler(margin_mm, page_mm.y - margin_mm);
    draw_dimension(sheet, ruler, ruler + glm::dvec2(100.0, 0.0), {0.0, -4.0},
                   "100: measure it after printing");
    sheet.text(
        ruler + glm::dvec2(0.0, 4.0),
        fmt::format("The prop of {}, true size in mm. Red, dashed: fold. Black: cut. Grey: tabs.", name));
    return sheet.take();
}

} // namespace frustumscreen::drawing
