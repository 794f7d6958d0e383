#include "app/drawing/a3_sheet.h"
#include "app/drawing/dimension.h"
#include "app/drawing/drawing.h"
#include "app/settings/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace frustumscreen::drawing {

namespace {

constexpr Pen wood{.stroke = "#000000", .width_mm = 0.35, .fill = "#e6e0d8"};
constexpr Pen white_prop{.stroke = "#000000", .width_mm = 0.5, .fill = "#ffffff"};
constexpr Pen panel{.stroke = "#20508a", .width_mm = 0.8, .fill = "#20508a"};
constexpr Pen seen{.stroke = "none", .width_mm = 0.0, .fill = "#e4effa"};
constexpr Pen sight{.stroke = "#5080b0", .width_mm = 0.2, .fill = "none", .dashes = "3 1"};
constexpr Pen plain{.stroke = "#444444", .width_mm = 0.2, .fill = "#c8ecd0"};
constexpr Pen before_screen{.stroke = "#444444", .width_mm = 0.2, .fill = "#ffd9b8"};
constexpr Pen building{.stroke = "#888888", .width_mm = 0.2, .fill = "none"};

constexpr glm::dvec2 views_low_mm(24.0, 24.0);
constexpr glm::dvec2 views_high_mm(252.0, 270.0);
constexpr double between_mm = 24.0; ///< the views
constexpr double list_mm = 262.0;   ///< its left edge
constexpr double line_mm = 4.0;
constexpr double list_top_mm = 24.0;
constexpr double list_bottom_mm = 236.0;
constexpr std::size_t max_lines = 52; ///< of objects
/// An object this large holds the others: a floor, a wall.
constexpr double building_m = 1.0;
/// Millimetres of paper per metre; those of ISO 5455, and 1 : 25 between them.
constexpr std::array scales{500.0, 200.0, 100.0, 50.0, 40.0, 20.0, 10.0, 5.0, 2.0, 1.0};

/// Two views with one scale: from above, y to the right, and from the right, y to the right and z up.
class RoomDrawing {
public:
    RoomDrawing(const settings::Settings& settings, std::span<const DrawnObject> objects,
                std::string_view name)
        : settings_(settings), objects_(objects), order_(objects.size()),
          sheet_(a3_sheet("Room behind the screen", name)) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::stable_sort(order_.begin(), order_.end(),
                         [&](std::size_t a, std::size_t b) { return objects[a].size_m > objects[b].size_m; });
        find_views();
    }

    std::string draw() {
        draw_plan();
        draw_side();
        draw_list();
        return sheet_.take();
    }

private:
    using Corners = std::vector<glm::dvec2>;
    static glm::dvec2 from_above(const glm::dvec3& at_m) { return {at_m.y, -at_m.x}; }
    static glm::dvec2 from_right(const glm::dvec3& at_m) { return {at_m.y, at_m.z}; }

    /// Places that both views show, apart from the objects.
    [[nodiscard]] std::vector<glm::dvec3> places() const {
        const double x = 0.5 * settings_.table.width_m;
        const double y = 0.5 * settings_.table.depth_m;
        std::vector<glm::dvec3> places{{-x, -y, 0.0}, {x, y, 0.0}, settings_.eye.default_m};
        places.insert(places.end(), settings_.screen.corners_m.begin(), settings_.screen.corners_m.end());
        return places;
    }

    void find_views() {
        Extent& plan = plan_extent_;
        Extent& side = side_extent_;
        for (const glm::dvec3& place : places()) {
            plan.include(from_above(place));
            side.include(from_right(place));
        }
        for (const DrawnObject& object : objects_) {
            for (const glm::dvec2& corner : object.foot_m) {
                plan.include(from_above(glm::dvec3(corner, 0.0)));
                side.include({corner.y, object.low_m});
                side.include({corner.y, object.high_m});
            }
        }
        const glm::dvec2 field = views_high_mm - views_low_mm;
        const double across = plan.high.x - plan.low.x;
        const double up = plan.high.y - plan.low.y + side.high.y - side.low.y;
        const auto* const scale = std::find_if(scales.begin(), scales.end() - 1, [&](double mm_per_m) {
            return mm_per_m * across <= field.x && mm_per_m * up <= field.y - between_mm;
        });
        const double left = 0.5 * (views_low_mm.x + views_high_mm.x - *scale * across) - *scale * plan.low.x;
        plan_ = {{left, views_low_mm.y + *scale * plan.high.y}, *scale};
        const double side_top = plan_({0.0, plan.low.y}).y + between_mm;
        side_ = {{left, side_top + *scale * side.high.y}, *scale};
    }

    [[nodiscard]] const Pen& pen_of(const DrawnObject& object) const {
        const double screen_m = 0.5 * (settings_.screen.corners_m[0].y + settings_.screen.corners_m[3].y);
        return object.size_m >= building_m ? building : object.place_m.y < screen_m ? before_screen : plain;
    }

    /// Draws the part of the room that the eye sees through the screen, as far as the view's objects reach; `flat` makes a view's place.
    void draw_sight(const View& view, const Extent& extent, const auto& flat, const glm::dvec3& a,
                    const glm::dvec3& b) {
        const glm::dvec3& eye = settings_.eye.default_m;
        const auto behind = [&](const glm::dvec3& through) {
            const double reach = through.y - eye.y;
            return reach > 1e-6 ? eye + (through - eye) * std::fmax((extent.high.x - eye.y) / reach, 1.0)
                                : through;
        };
        settings::Polygon within{flat(a), flat(behind(a)), flat(behind(b)), flat(b)};
        for (const settings::HalfPlane& side : {settings::HalfPlane{{0.0, -1.0}, -extent.high.y},
                                                settings::HalfPlane{{0.0, 1.0}, extent.low.y}}) {
            within = settings::clipped(within, side);
        }
        sheet_.polygon(view(within), seen);
        for (const glm::dvec3& through : {a, b}) {
            sheet_.line(view(flat(eye)), view(flat(through)), sight);
        }
    }

    void draw_eye(const glm::dvec2& at) {
        sheet_.circle(at, 1.6, {.stroke = "#20508a", .width_mm = 0.5, .fill = "#ffffff"});
        sheet_.circle(at, 0.6, {.stroke = "none", .width_mm = 0.0, .fill = "#20508a"});
    }

    void draw_plan() {
        const auto& [top_left, top_right, bottom_right, bottom_left] = settings_.screen.corners_m;
        sheet_.text({16.0, 18.0}, "From above, scale " + scale_words(plan_), heading);
        sheet_.begin_view("plan", plan_.origin_mm, plan_.mm_per_m);
        draw_sight(plan_, plan_extent_, from_above, top_left, top_right);
        const double x = 0.5 * settings_.table.width_m;
        const double y = 0.5 * settings_.table.depth_m;
        sheet_.polygon(plan_(Corners{{-y, x}, {-y, -x}, {y, -x}, {y, x}}), wood, "table");
        Corners foot;
        for (const glm::dvec3& corner : settings::make_prop(settings_.prop).corners) {
            foot.push_back(from_above(corner));
        }
        sheet_.polygon(plan_(settings::convex_polygon(std::move(foot))), white_prop, "prop");
        for (const std::size_t k : order_) {
            Corners corners;
            for (const glm::dvec2& corner : objects_[k].foot_m) {
                corners.push_back(from_above(glm::dvec3(corner, 0.0)));
            }
            sheet_.polygon(plan_(corners), pen_of(objects_[k]), objects_[k].name);
        }
        const Corners lit{from_above(top_left), from_above(top_right), from_above(bottom_right),
                          from_above(bottom_left)};
        sheet_.polygon(plan_(lit), panel, "screen");
        draw_eye(plan_(from_above(settings_.eye.default_m)));
        sheet_.end_view();
        draw_numbers();
    }

    void draw_side() {
        const auto& [top_left, top_right, bottom_right, bottom_left] = settings_.screen.corners_m;
        const glm::dvec3 top = 0.5 * (top_left + top_right);
        const glm::dvec3 bottom = 0.5 * (bottom_left + bottom_right);
        double highest = side_(from_right(top)).y;
        for (const DrawnObject& object : objects_) {
            highest = std::fmin(highest, side_({0.0, object.high_m}).y);
        }
        sheet_.text({16.0, std::fmin(highest, side_(from_right(settings_.eye.default_m)).y) - 6.0},
                    "From the right", heading);
        sheet_.begin_view("side", side_.origin_mm, side_.mm_per_m);
        draw_sight(side_, side_extent_, from_right, top, bottom);
        for (const std::size_t k : order_) {
            const DrawnObject& object = objects_[k];
            double near_m = object.foot_m.front().y;
            double far_m = near_m;
            for (const glm::dvec2& corner : object.foot_m) {
                near_m = std::fmin(near_m, corner.y);
                far_m = std::fmax(far_m, corner.y);
            }
            const Corners corners{{near_m, object.low_m},
                                  {far_m, object.low_m},
                                  {far_m, object.high_m},
                                  {near_m, object.high_m}};
            sheet_.polygon(side_(corners), pen_of(object), object.name);
        }
        constexpr double board_m = 0.03; // drawn thickness; not a setting
        const double y = 0.5 * settings_.table.depth_m;
        sheet_.polygon(side_(Corners{{-y, -board_m}, {y, -board_m}, {y, 0.0}, {-y, 0.0}}), wood, "table");
        Corners prop;
        for (const glm::dvec3& corner : settings::make_prop(settings_.prop).corners) {
            prop.push_back(from_right(corner));
        }
        sheet_.polygon(side_(settings::convex_polygon(std::move(prop))), white_prop, "prop");
        const Corners lit{from_right(top_left), from_right(top_right), from_right(bottom_right),
                          from_right(bottom_left)};
        sheet_.polygon(side_(lit), panel, "screen");
        draw_eye(side_(from_right(settings_.eye.default_m)));
        sheet_.end_view();
    }

    /// The numbers of the list, one text for all objects that stand at one place.
    void draw_numbers() {
        constexpr double same_m = 0.01;
        std::vector<bool> told(objects_.size(), false);
        for (std::size_t k = 0; k < std::min(objects_.size(), max_lines); ++k) {
            if (told[k] || objects_[k].size_m >= building_m) {
                continue;
            }
            std::string numbers;
            for (std::size_t other = k; other < std::min(objects_.size(), max_lines); ++other) {
                if (glm::distance(glm::dvec2(objects_[other].place_m), glm::dvec2(objects_[k].place_m)) <
                    same_m) {
                    numbers += fmt::format("{}{}", numbers.empty() ? "" : ", ", other + 1);
                    told[other] = true;
                }
            }
            sheet_.text(plan_(from_above(objects_[k].place_m)) + glm::dvec2(0.0, 0.8), numbers,
                        {.height_mm = 2.2, .anchor = TextAnchor::Middle, .turned_deg = 0.0, .bold = false});
        }
    }

    void note(double& y_mm, std::string_view words, const Pen& pen) {
        const glm::dvec2 at(list_mm + 3.0, y_mm - 1.0);
        constexpr glm::dvec2 half(2.6, 1.3);
        const Corners corners{at - half, at + glm::dvec2(half.x, -half.y), at + half,
                              at + glm::dvec2(-half.x, half.y)};
        sheet_.polygon(corners, pen);
        sheet_.text({list_mm + 8.0, y_mm}, words, {2.4});
        y_mm += line_mm;
    }

    void draw_list() {
        sheet_.text({list_mm, 18.0}, "Its objects: place x, y, z; longest edge", heading);
        double y_mm = list_top_mm;
        const std::size_t named = std::min(objects_.size(), max_lines);
        for (std::size_t k = 0; k < named; ++k) {
            const DrawnObject& object = objects_[k];
            constexpr std::size_t max_letters = 36;
            sheet_.text({list_mm + 6.0, y_mm}, fmt::format("{}", k + 1), {2.4, TextAnchor::End});
            sheet_.text({list_mm + 8.0, y_mm}, object.name.substr(0, max_letters), {2.4});
            sheet_.text({list_mm + 112.0, y_mm},
                        fmt::format("{}, {}, {}", mm_words(object.place_m.x), mm_words(object.place_m.y),
                                    mm_words(object.place_m.z)),
                        {2.4, TextAnchor::End});
            sheet_.text({list_mm + 128.0, y_mm}, mm_words(object.size_m), {2.4, TextAnchor::End});
            sheet_.text({list_mm + 130.0, y_mm}, object.moves ? "moves" : "", {2.4});
            y_mm += line_mm;
        }
        if (named < objects_.size()) {
            sheet_.text({list_mm + 8.0, y_mm},
                        fmt::format("and {} more, without numbers", objects_.size() - named), {2.4});
        }
        y_mm = list_bottom_mm;
        const auto& corners = settings_.screen.corners_m;
        note(y_mm,
             fmt::format("The screen's lit area, {} x {}", mm_words(glm::distance(corners[0], corners[1])),
                         mm_words(glm::distance(corners[0], corners[3]))),
             panel);
        note(y_mm, "The prop, at the table's centre", white_prop);
        note(y_mm, "An object behind the screen", plain);
        note(y_mm, "An object before it: it comes out of the screen", before_screen);
        note(y_mm, "A large one, such as a floor or a wall", building);
        note(y_mm, "What is seen of the room from the eye while no head is tracked", seen);
    }

    const settings::Settings& settings_;
    std::span<const DrawnObject> objects_;
    std::vector<std::size_t> order_; ///< the largest first, so that the others lie on it
    SvgSheet sheet_;
    Extent plan_extent_, side_extent_; ///< of what the views show
    View plan_, side_;
};

} // namespace

std::string room_sheet(const settings::Settings& settings, std::span<const DrawnObject> objects,
                       std::string_view name) {
    return RoomDrawing(settings, objects, name).draw();
}

} // namespace frustumscreen::drawing
