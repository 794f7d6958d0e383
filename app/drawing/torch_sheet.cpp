#include "app/drawing/a3_sheet.h"
#include "app/drawing/dimension.h"
#include "app/drawing/drawing.h"
#include "app/settings/polygon.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace frustumscreen::drawing {

namespace {

/// The tube's sizes, metres: it fits a hand, holds a sensor of 25 mm, and does not pass the holder's ring.
constexpr double tube_m = 0.036, length_m = 0.15, wall_m = 0.003;
constexpr double collar_m = 0.046, collar_from_m = 0.060, collar_thick_m = 0.004;
/// The holder: a plate with a ring, below the table's top.
constexpr double ring_m = 0.038, plate_wide_m = 0.062, plate_long_m = 0.11, plate_thick_m = 0.006;
constexpr double ring_from_edge_m = 0.055, below_top_m = 0.020;
/// A tag's white border on each side, of the black square.
constexpr double border_share = 1.0 / 8.0;
/// A sensor such as Polhemus's standard one, its length along the tube.
constexpr glm::dvec3 sensor_m{0.0229, 0.0152, 0.0279};

constexpr Pen body{.stroke = "#000000", .width_mm = 0.5, .fill = "#f0f0f0"};
constexpr Pen part{.stroke = "#000000", .width_mm = 0.35, .fill = "#d8d8d8"};
constexpr Pen red{.stroke = "#a02020", .width_mm = 0.4, .fill = "#ffe0e0"};
constexpr Pen axis{.stroke = "#444444", .width_mm = 0.2, .fill = "none", .dashes = "6 1.5 1 1.5"};
constexpr Pen light{.stroke = "#c08000", .width_mm = 0.25, .fill = "none", .dashes = "3 1"};

/// A view along an axis of the torch: two of its coordinates.
using Project = glm::dvec2 (*)(const glm::dvec3&);
glm::dvec2 from_side(const glm::dvec3& p) { // from the torch's right: light to the right, up is up
    return {p.z, -p.y};
}
glm::dvec2 from_above(const glm::dvec3& p) {
    return {p.z, -p.x};
}
glm::dvec2 from_front(const glm::dvec3& p) { // against the light
    return {-p.x, -p.y};
}

std::vector<glm::dvec2> box(double x0, double x1, double y0, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// The corners of a flat rectangle, or the outline of what is seen of a box.
std::vector<glm::dvec2> outline_of(const geometry::RigidTransform& torch_from_part, const glm::dvec3& half,
                                   Project project) {
    std::vector<glm::dvec2> places;
    for (int k = 0; k < 8; ++k) {
        const glm::dvec3 sign((k & 1) != 0 ? 1.0 : -1.0, (k & 2) != 0 ? 1.0 : -1.0,
                              (k & 4) != 0 ? 1.0 : -1.0);
        places.push_back(project(torch_from_part.point(sign * half)));
    }
    return settings::convex_polygon(std::move(places));
}

void circle(SvgSheet& sheet, const View& view, const glm::dvec2& middle, double diameter_m, const Pen& pen) {
    sheet.circle(view(middle), 0.5 * diameter_m * view.mm_per_m, pen);
}

class TorchSheet {
public:
    TorchSheet(const settings::TorchSettings& torch, std::string_view name)
        : torch_(torch), torch_from_sensor_(torch.sensor_from_torch.inverse()),
          sheet_(a3_sheet("Torch", name)) {}

    std::string draw() {
        side({{185.0, 75.0}, 1000.0});
        above({{185.0, 165.0}, 1000.0});
        front({{243.0, 75.0}, 1000.0});
        holder({{345.0, 95.0}, 1000.0});
        notes();
        return sheet_.take();
    }

private:
    void tube(const View& view, std::string_view name) {
        sheet_.begin_view(name, view.origin_mm, view.mm_per_m);
        sheet_.polygon(view(box(-length_m, 0.0, -0.5 * tube_m, 0.5 * tube_m)), body, "tube");
        sheet_.polygon(
            view(box(-collar_from_m - collar_thick_m, -collar_from_m, -0.5 * collar_m, 0.5 * collar_m)), part,
            "collar");
        sheet_.end_view();
        sheet_.line(view(glm::dvec2(-length_m - 0.008, 0.0)), view(glm::dvec2(0.035, 0.0)), axis);
        const double half = 0.5 * torch_.beam.opening_rad;
        const double far = 0.03;
        const double rise = std::fmin(far * std::tan(std::fmin(half, 1.2)), 0.03);
        sheet_.line(view(glm::dvec2(0.0)), view(glm::dvec2(far, rise)), light);
        sheet_.line(view(glm::dvec2(0.0)), view(glm::dvec2(far, -rise)), light);
        sheet_.circle(view(glm::dvec2(0.0)), 1.0, red);
    }
    void fittings(const View& view, Project project) {
        if (torch_.by_tracker() || !torch_.by_camera()) {
            sheet_.polygon(view(outline_of(torch_from_sensor_, 0.5 * sensor_m, project)), red, "sensor");
        }
        if (torch_.by_camera()) {
            const double half = 0.5 * torch_.tag.size_m * (1.0 + 2.0 * border_share);
            const geometry::RigidTransform torch_from_tag = settings::prop_from_tag(torch_.tag);
            sheet_.polygon(view(outline_of(torch_from_tag, {half, half, 0.001}, project)), part, "tag plate");
        }
    }
    void side(const View& view) {
        sheet_.text({16.0, 24.0}, "From the side", heading);
        tube(view, "side");
        fittings(view, from_side);
        draw_dimension(sheet_, view(glm::dvec2(-length_m, -0.5 * tube_m)),
                       view(glm::dvec2(0.0, -0.5 * tube_m)), {0.0, 18.0}, mm_words(length_m));
        draw_dimension(sheet_, view(glm::dvec2(-collar_from_m, -0.5 * collar_m)),
                       view(glm::dvec2(0.0, -0.5 * collar_m)), {0.0, 5.0}, mm_words(collar_from_m));
    }
    void above(const View& view) {
        sheet_.text({16.0, 120.0}, "From above", heading);
        tube(view, "above");
        fittings(view, from_above);
        if (torch_.by_camera()) {
            const double half = 0.5 * torch_.tag.size_m * (1.0 + 2.0 * border_share);
            const glm::dvec3 middle = torch_.tag.centre_m;
            draw_dimension(sheet_, view(glm::dvec2(middle.z - half, -middle.x - half)),
                           view(glm::dvec2(middle.z + half, -middle.x - half)), {0.0, 8.0},
                           mm_words(2.0 * half));
        }
    }
    void front(const View& view) {
        sheet_.text({220.0, 24.0}, "From the front", heading);
        circle(sheet_, view, {}, collar_m, part);
        circle(sheet_, view, {}, tube_m, body);
        circle(sheet_, view, {}, tube_m - 2.0 * wall_m,
               {.stroke = "#000000", .width_mm = 0.35, .fill = "#ffffff"});
        sheet_.begin_view("front", view.origin_mm, view.mm_per_m);
        fittings(view, from_front);
        sheet_.end_view();
        draw_dimension(sheet_, view(glm::dvec2(-0.5 * tube_m, 0.0)), view(glm::dvec2(0.5 * tube_m, 0.0)),
                       {0.0, 30.0}, mm_words(tube_m));
        draw_dimension(sheet_, view(glm::dvec2(-0.5 * collar_m, 0.0)), view(glm::dvec2(0.5 * collar_m, 0.0)),
                       {0.0, 38.0}, mm_words(collar_m));
    }
    /// From above; the table's edge runs across.
    void holder(const View& view) {
        sheet_.text({314.0, 24.0}, "Holder, from above", heading);
        sheet_.begin_view("holder", view.origin_mm, view.mm_per_m);
        sheet_.polygon(view(box(-0.5 * plate_wide_m, 0.5 * plate_wide_m, ring_from_edge_m - plate_long_m,
                                ring_from_edge_m)),
                       body, "plate");
        sheet_.end_view();
        const double edge = ring_from_edge_m - 0.02;
        circle(sheet_, view, {0.0, ring_from_edge_m - plate_long_m + 0.5 * plate_wide_m}, ring_m,
               {.stroke = "#000000", .width_mm = 0.5, .fill = "#ffffff"});
        for (const double x : {-0.02, 0.02}) {
            circle(sheet_, view, {x, ring_from_edge_m - 0.01}, 0.0045,
                   {.stroke = "#000000", .width_mm = 0.35, .fill = "#ffffff"});
        }
        sheet_.line(view(glm::dvec2(-0.05, edge)), view(glm::dvec2(0.05, edge)), axis);
        sheet_.text(view(glm::dvec2(-0.052, edge)) + glm::dvec2(0.0, 1.0), "the table's edge",
                    {.anchor = TextAnchor::End});
        const double low = ring_from_edge_m - plate_long_m;
        draw_dimension(sheet_, view(glm::dvec2(-0.5 * plate_wide_m, low)),
                       view(glm::dvec2(0.5 * plate_wide_m, low)), {0.0, 8.0}, mm_words(plate_wide_m));
        draw_dimension(sheet_, view(glm::dvec2(0.5 * plate_wide_m, low)),
                       view(glm::dvec2(0.5 * plate_wide_m, ring_from_edge_m)), {12.0, 0.0},
                       mm_words(plate_long_m));
        draw_dimension(sheet_, view(glm::dvec2(-0.5 * ring_m, low + 0.5 * plate_wide_m)),
                       view(glm::dvec2(0.5 * ring_m, low + 0.5 * plate_wide_m)), {0.0, -22.0},
                       mm_words(ring_m));
    }
    void notes() {
        const glm::dvec3& at = torch_from_sensor_.translation;
        std::vector<std::string> lines{
            "Scale 1 : 1. Red dot: where the light comes from, the torch's zero; +Z along the light, +X "
            "right, +Y down.",
            fmt::format(
                "Tube: plastic, no metal, walls {} thick. It needs no lamp: the projector makes its light.",
                mm_words(wall_m))};
        if (torch_.by_tracker() || !torch_.by_camera()) {
            lines.push_back(fmt::format(
                "Red: the sensor (station 3). Its zero is at x {}, y {}, z {} (torch.sensor_from_torch).",
                mm_words(at.x), mm_words(at.y), mm_words(at.z)));
            lines.emplace_back("The sensor's cable leaves at the rear end, with a loop tied in the tube so "
                               "that no pull reaches it.");
        }
        if (torch_.by_camera()) {
            const glm::dvec3& middle = torch_.tag.centre_m;
            lines.push_back(fmt::format("Tag {} of the family 36h11, black square {}: its middle at x {}, y "
                                        "{}, z {}, matt print on a flat plate with a foot.",
                                        torch_.tag.id, mm_words(torch_.tag.size_m), mm_words(middle.x),
                                        mm_words(middle.y), mm_words(middle.z)));
        }
        lines.push_back(fmt::format(
            "Holder: {} thick, screwed below the table's top so that its upper side is {} or more below it.",
            mm_words(plate_thick_m), mm_words(below_top_m)));
        lines.emplace_back("The torch hangs in its ring by the collar, light down; the exhibit sees it below "
                           "the table's plane and puts it out.");
        double y_mm = 240.0;
        for (const std::string& line : lines) {
            sheet_.text({16.0, y_mm}, line, {2.8});
            y_mm += 5.2;
        }
    }

    const settings::TorchSettings& torch_;
    geometry::RigidTransform torch_from_sensor_;
    SvgSheet sheet_;
};

} // namespace

std::string torch_sheet(const settings::Settings& settings, std::string_view name) {
    return TorchSheet(settings.torch, name).draw();
}

} // namespace frustumscreen::drawing
