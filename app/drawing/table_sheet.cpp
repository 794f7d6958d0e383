#include "app/drawing/a3_sheet.h"
#include "app/drawing/dimension.h"
#include "app/drawing/drawing.h"
#include "app/drawing/table_notes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::drawing {

namespace {

constexpr double board_m = 0.03; ///< drawn thickness of the table top; not a setting
constexpr double symbol_mm = 2.0;
constexpr double max_of_eye_zone_m = 2.5; ///< a larger distance is only in the notes
constexpr Pen light{.stroke = "#b08000", .width_mm = 0.25, .fill = "#fff3b8"};
constexpr Pen light_edge{"#b08000", 0.25};
constexpr Pen zone_pen{.stroke = "#107030", .width_mm = 0.35, .fill = "#c8ecd0"};
constexpr Pen eye_zone{.stroke = "#5080b0", .width_mm = 0.2, .fill = "#e4effa", .dashes = "3 1"};
constexpr Pen wood{.stroke = "#000000", .width_mm = 0.35, .fill = "#e6e0d8"};
constexpr Pen white_prop{.stroke = "#000000", .width_mm = 0.5, .fill = "#ffffff"};
constexpr Pen symbol{.stroke = "#000000", .width_mm = 0.35, .fill = "#ffffff"};

void draw_lens(SvgSheet& sheet, const glm::dvec2& at) {
    sheet.circle(at, symbol_mm, symbol);
    sheet.line(at - glm::dvec2(1.5 * symbol_mm, 0.0), at + glm::dvec2(1.5 * symbol_mm, 0.0), fine);
    sheet.line(at - glm::dvec2(0.0, 1.5 * symbol_mm), at + glm::dvec2(0.0, 1.5 * symbol_mm), fine);
}

void draw_eye(SvgSheet& sheet, const glm::dvec2& at) {
    sheet.circle(at, symbol_mm, {.stroke = "#20508a", .width_mm = 0.5, .fill = "#ffffff"});
    sheet.circle(at, 0.4 * symbol_mm, {.stroke = "none", .width_mm = 0.0, .fill = "#20508a"});
}

void draw_tracker(SvgSheet& sheet, const glm::dvec2& at) {
    const glm::dvec2 corners[] = {at + symbol_mm * glm::dvec2(0.0, -1.2),
                                  at + symbol_mm * glm::dvec2(1.1, 0.8),
                                  at + symbol_mm * glm::dvec2(-1.1, 0.8)};
    sheet.polygon(corners, {.stroke = "#a02020", .width_mm = 0.5, .fill = "#ffe0e0"});
}

void draw_sample(SvgSheet& sheet, const glm::dvec2& at, const Pen& pen) {
    constexpr glm::dvec2 half(3.0, 1.6);
    const glm::dvec2 corners[] = {at - half, at + glm::dvec2(half.x, -half.y), at + half,
                                  at + glm::dvec2(-half.x, half.y)};
    sheet.polygon(corners, pen);
}

struct Symbol {
    glm::dvec2 place{0.0}; ///< metres
    void (*draw)(SvgSheet& sheet, const glm::dvec2& at) = nullptr;
};

/// One view from the side (seen from the right: y to the right, z up) and one from above.
class TableDrawing {
public:
    TableDrawing(const settings::Settings& settings, std::string_view name)
        : settings_(settings), zone_(settings::lit_zone(settings)), place_(drawn_place(zone_)),
          lens_(settings.projector.table_from_projector.translation),
          picture_(settings::picture_on_table(settings, 0.0)),
          sheet_(a3_sheet("Table, projector, prop", name)) {}

    std::string draw() {
        draw_side_view();
        draw_top_view();
        draw_notes();
        return sheet_.take();
    }

private:
    [[nodiscard]] double half_width() const { return 0.5 * settings_.table.width_m; }
    [[nodiscard]] double half_depth() const { return 0.5 * settings_.table.depth_m; }
    /// The prop's outline in a view along an axis, around `across_m`.
    [[nodiscard]] std::vector<glm::dvec2> prop_outline(double across_m) const {
        const settings::PropSettings& prop = settings_.prop;
        if (prop.kind == settings::PropKind::Solid) {
            return solid_outline(
                [&](const glm::dvec3& corner) { return glm::dvec2(across_m + corner.y, corner.z); });
        }
        const double bottom = 0.5 * prop.base_m;
        const double top = prop.kind == settings::PropKind::Cube ? bottom : 0.5 * prop.top_m;
        return {{across_m - bottom, 0.0},
                {across_m + bottom, 0.0},
                {across_m + top, prop.height_m},
                {across_m - top, prop.height_m}};
    }

    [[nodiscard]] std::vector<glm::dvec2> prop_from_above() const {
        if (settings_.prop.kind == settings::PropKind::Solid) {
            return solid_outline([&](const glm::dvec3& corner) { return place_ + glm::dvec2(corner); });
        }
        const double half = 0.5 * settings_.prop.base_m;
        return {place_ + glm::dvec2(-half, -half), place_ + glm::dvec2(half, -half),
                place_ + glm::dvec2(half, half), place_ + glm::dvec2(-half, half)};
    }
    [[nodiscard]] std::vector<glm::dvec2> solid_outline(const auto& drawn) const {
        std::vector<glm::dvec2> points;
        for (const glm::dvec3& corner : settings::make_prop(settings_.prop).corners) {
            points.push_back(drawn(corner));
        }
        return settings::convex_polygon(std::move(points));
    }

    /// The eye zone on the visitor's side of the prop, from the lowest elevation up to the vertical.
    [[nodiscard]] std::vector<glm::dvec2> eye_zone_outline() const {
        const settings::EyeSettings& eye = settings_.eye;
        const double lowest = glm::radians(eye.lowest_elevation_deg);
        const double farthest = std::fmin(eye.farthest_m, max_of_eye_zone_m);
        constexpr int pieces = 48;
        std::vector<glm::dvec2> outline;
        for (int k = 0; k <= 2 * pieces + 1; ++k) {
            const bool outer = k <= pieces;
            const double share = 1.0 * (outer ? k : 2 * pieces + 1 - k) / pieces;
            const double elevation = lowest + share * (0.5 * std::numbers::pi - lowest);
            const double radius = outer ? farthest : std::fmin(eye.nearest_m, farthest);
            outline.push_back(glm::dvec2(place_.y, 0.0) +
                              radius * glm::dvec2(-std::cos(elevation), std::sin(elevation)));
        }
        return outline;
    }

    [[nodiscard]] Extent side_extent() const {
        Extent extent;
        const double around_m = 0.05;
        extent.include({-half_depth(), -board_m});
        extent.include({half_depth(), 0.0});
        extent.include({lens_.y - around_m, lens_.z + around_m});
        extent.include({lens_.y + around_m, lens_.z + around_m});
        extent.include({settings_.eye.default_m.y, settings_.eye.default_m.z});
        for (const glm::dvec2& place : eye_zone_outline()) {
            extent.include(place);
        }
        if (has_tracker_place(settings_)) {
            const glm::dvec3& tracker = settings_.tracker.registration.table_from_tracker.translation;
            extent.include({tracker.y, tracker.z});
        }
        return extent;
    }

    void draw_side_light(const View& view) {
        for (std::size_t k = 0; k < picture_.size(); ++k) {
            const glm::dvec2& a = picture_[k];
            const glm::dvec2& b = picture_[(k + 1) % picture_.size()];
            const glm::dvec2 corners[] = {view({lens_.y, lens_.z}), view({a.y, 0.0}), view({b.y, 0.0})};
            sheet_.polygon(corners, {.stroke = "none", .width_mm = 0.0, .fill = light.fill});
        }
        for (const glm::dvec2& corner : picture_) {
            sheet_.line(view({lens_.y, lens_.z}), view({corner.y, 0.0}), light_edge);
        }
    }

    void draw_side_view() {
        const Extent extent = side_extent();
        const View view = fitted_view(extent, {28.0, 24.0}, {247.0, 250.0});
        sheet_.text({16.0, 18.0}, "From the side, scale " + scale_words(view), heading);
        sheet_.begin_view("side", view.origin_mm, view.mm_per_m);
        sheet_.polygon(view(eye_zone_outline()), eye_zone, "eyes");
        draw_side_light(view);
        const std::vector<glm::dvec2> board{
            {-half_depth(), -board_m}, {half_depth(), -board_m}, {half_depth(), 0.0}, {-half_depth(), 0.0}};
        sheet_.polygon(view(board), wood, "table");
        sheet_.polygon(view(prop_outline(place_.y)), white_prop, "prop");
        draw_lens(sheet_, view({lens_.y, lens_.z}));
        draw_eye(sheet_, view({settings_.eye.default_m.y, settings_.eye.default_m.z}));
        if (has_tracker_place(settings_)) {
            const glm::dvec3& tracker = settings_.tracker.registration.table_from_tracker.translation;
            draw_tracker(sheet_, view({tracker.y, tracker.z}));
        }
        sheet_.end_view();
        dimension_side_view(view, extent);
    }

    void dimension_side_view(const View& view, const Extent& extent) {
        const glm::dvec2 low = view(extent.low);   // bottom left on the paper
        const glm::dvec2 high = view(extent.high); // top right
        const double right = high.x + 6.0;
        // Dimension from the table top up to a place, at x_mm of the paper.
        const auto upright = [&](const glm::dvec2& at_m, double table_y_m, double x_mm) {
            const glm::dvec2 foot = view({table_y_m, 0.0});
            const glm::dvec2 head = view(at_m);
            const double beyond_mm = x_mm > head.x ? 1.2 : -1.2;
            sheet_.line(foot, {x_mm + beyond_mm, foot.y}, fine);
            sheet_.line(head, {x_mm + beyond_mm, head.y}, fine);
            draw_dimension(sheet_, {x_mm, foot.y}, {x_mm, head.y}, glm::dvec2(0.0), mm_words(at_m.y));
        };
        upright({place_.y + 0.5 * settings_.prop.top_m, settings_.prop.height_m}, half_depth(), right);
        upright({lens_.y, lens_.z}, half_depth(), right + 9.0);
        const glm::dvec3& eye = settings_.eye.default_m;
        upright({eye.y, eye.z}, -half_depth(), low.x - 8.0);
        const double table_y = view({0.0, -board_m}).y;
        const auto across = [&](double from_m, double to_m, double lane_mm) {
            const glm::dvec2 from(view({from_m, 0.0}).x, table_y);
            const glm::dvec2 to(view({to_m, 0.0}).x, table_y);
            draw_dimension(sheet_, from, to, {0.0, lane_mm}, mm_words(std::abs(to_m - from_m)));
        };
        across(-half_depth(), half_depth(), 8.0);
        // From the front edge: a line at the middle would cross the words of the table's own dimension.
        constexpr double min_m = 5e-4;
        if (eye.y < -half_depth() - min_m) {
            across(-half_depth(), eye.y, 8.0); // words that do not fit are on the visitor's side
        } else if (eye.y > -half_depth() + min_m) {
            across(-half_depth(), eye.y, 16.0);
        }
        if (std::abs(lens_.y) > min_m && std::abs(lens_.y + half_depth()) > min_m) {
            across(std::fmin(lens_.y, -half_depth()), std::fmax(lens_.y, -half_depth()), 24.0);
        }
        const double left_m = std::fmin(-half_depth(), eye.y);
        constexpr double leftmost_mm = 44.0; // these words end at the frame
        sheet_.text({std::fmax(leftmost_mm, view({left_m, 0.0}).x - 3.0), table_y + 4.0}, "visitor's side",
                    {2.8, TextAnchor::End});
    }

    [[nodiscard]] Extent top_extent() const {
        Extent extent;
        extent.include({-half_width(), -half_depth()});
        extent.include({half_width(), half_depth()});
        for (const auto& [place, draw] : symbols_from_above()) {
            extent.include(place);
        }
        return extent;
    }

    /// Symbols of lens, eyes and tracker. Distant ones would reduce the table's scale, and are only in the
    /// notes.
    [[nodiscard]] std::vector<Symbol> symbols_from_above() const {
        std::vector<Symbol> symbols{{glm::dvec2(lens_), draw_lens},
                                    {glm::dvec2(settings_.eye.default_m), draw_eye}};
        if (has_tracker_place(settings_)) {
            symbols.push_back(
                {glm::dvec2(settings_.tracker.registration.table_from_tracker.translation), draw_tracker});
        }
        const double max_m = 2.5 * std::fmax(half_width(), half_depth());
        std::erase_if(symbols, [&](const Symbol& symbol) { return glm::length(symbol.place) > max_m; });
        return symbols;
    }

    void draw_top_view() {
        const Extent extent = top_extent();
        const View view = fitted_view(extent, {288.0, 36.0}, {394.0, 136.0});
        sheet_.text({284.0, 18.0}, "From above, scale " + scale_words(view), heading);
        sheet_.begin_view("top", view.origin_mm, view.mm_per_m);
        const std::vector<glm::dvec2> table{{-half_width(), -half_depth()},
                                            {half_width(), -half_depth()},
                                            {half_width(), half_depth()},
                                            {-half_width(), half_depth()}};
        sheet_.polygon(view(table), wood, "table");
        sheet_.polygon(view(picture_), light, "picture");
        if (!zone_.any_eye.empty()) {
            sheet_.polygon(view(zone_.any_eye), zone_pen, "zone");
        }
        sheet_.polygon(view(prop_from_above()), {"#000000", 0.5}, "prop");
        for (const auto& [place, draw] : symbols_from_above()) {
            draw(sheet_, view(place));
        }
        sheet_.end_view();
        const double lane_mm = std::fmax(7.0, view(table[2]).y - view(extent.high).y + 7.0);
        draw_dimension(sheet_, view(table[3]), view(table[2]), {0.0, -lane_mm},
                       mm_words(settings_.table.width_m));
        const double right_mm = view(extent.high).x - view(table[1]).x + 8.0;
        draw_dimension(sheet_, view(table[2]), view(table[1]), {right_mm, 0.0},
                       mm_words(settings_.table.depth_m));
    }

    /// `sample` draws the symbol that the lines describe, next to the first line.
    void note(double& y_mm, const std::vector<std::string>& lines, const auto& sample) {
        constexpr double line_mm = 4.4;
        constexpr glm::dvec2 left(284.0, 0.0);
        sample(glm::dvec2(left.x + 2.0, y_mm - 1.0));
        for (const std::string& line : lines) {
            sheet_.text({left.x + 9.0, y_mm}, line, {2.6});
            y_mm += line_mm;
        }
        y_mm += 0.35 * line_mm;
    }

    void draw_notes() {
        const TableNotes notes = table_notes(settings_, zone_);
        double y_mm = 156.0;
        note(y_mm, notes.light, [&](const glm::dvec2& at) { draw_sample(sheet_, at, light); });
        note(y_mm, {"The prop, in the middle of where it may be"},
             [&](const glm::dvec2& at) { draw_sample(sheet_, at, white_prop); });
        note(y_mm, notes.zone, [&](const glm::dvec2& at) { draw_sample(sheet_, at, zone_pen); });
        note(y_mm, notes.eyes, [&](const glm::dvec2& at) { draw_sample(sheet_, at, eye_zone); });
        note(y_mm, notes.lens, [&](const glm::dvec2& at) { draw_lens(sheet_, at); });
        note(y_mm, notes.eye, [&](const glm::dvec2& at) { draw_eye(sheet_, at); });
        note(y_mm, notes.tracker, [&](const glm::dvec2& at) {
            if (has_tracker_place(settings_)) {
                draw_tracker(sheet_, at);
            }
        });
        note(y_mm, notes.checks, [](const glm::dvec2&) {});
    }

    const settings::Settings& settings_;
    settings::LitZone zone_;
    glm::dvec2 place_;
    glm::dvec3 lens_;
    settings::Polygon picture_;
    SvgSheet sheet_;
};

} // namespace

std::string table_sheet(const settings::Settings& settings, std::string_view name) {
    return TableDrawing(settings, name).draw();
}

} // namespace frustumscreen::drawing
