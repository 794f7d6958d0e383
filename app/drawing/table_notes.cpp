#include "app/drawing/table_notes.h"

#include "app/drawing/svg_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::drawing {

namespace {

/// "12 to the right of the table's middle, 30 in front of it, 500 above"; zeros are omitted.
std::string place_words(const glm::dvec3& at) {
    constexpr double nothing_m = 5e-5;
    std::string words;
    const auto add = [&](double metres, const char* plus, const char* minus) {
        if (std::abs(metres) >= nothing_m) {
            words += fmt::format("{} {}, ", mm_words(std::abs(metres)), metres < 0.0 ? minus : plus);
        }
    };
    add(at.x, "to the right", "to the left");
    add(at.y, "behind", "in front");
    return fmt::format("{}{} {} the table's middle", words, mm_words(std::abs(at.z)),
                       at.z < 0.0 ? "below" : "above");
}

std::string span_words(double middle_m, double half_m) {
    return fmt::format("{} to {}", mm_words(middle_m - half_m), mm_words(middle_m + half_m));
}

std::vector<std::string> zone_words(const settings::Settings& settings, const settings::LitZone& zone) {
    const bool in_hand = settings.prop.zone == settings::PropZone::Hand;
    if (zone.any_eye.empty()) {
        return {"Nowhere on this table is the prop lit from all sides:",
                "frustumscreen config --explain says why."};
    }
    const settings::Rectangle& inside = zone.any_eye_rectangle;
    return {in_hand ? "Where the prop's middle may be held, so that all of it is lit:"
                    : "Where the prop's middle may stand, so that each side is lit at each turn:",
            fmt::format("all of x {}, y {}", span_words(inside.centre_m.x, inside.half_m.x),
                        span_words(inside.centre_m.y, inside.half_m.y))};
}

std::vector<std::string> lens_words(const settings::ProjectorSettings& projector) {
    const glm::dvec3 axis = projector.table_from_projector.direction({0.0, 0.0, 1.0});
    const double tilt_deg = glm::degrees(std::acos(std::clamp(-axis.z, -1.0, 1.0)));
    constexpr double straight_deg = 0.05;
    return {
        (tilt_deg < straight_deg
             ? std::string("The projector's lens, which looks straight down:")
             : fmt::format("The projector's lens, which looks {:.1f}\u00b0 off straight down:", tilt_deg)),
        place_words(projector.table_from_projector.translation),
        fmt::format("{} x {} pixels, throw ratio {:.4g} : 1", projector.pinhole.width,
                    projector.pinhole.height, projector.pinhole.fx / projector.pinhole.width)};
}

std::vector<std::string> tracker_words(const settings::Settings& settings) {
    return has_tracker_place(settings)
               ? std::vector<std::string>{"The tracker's zero:",
                                          place_words(
                                              settings.tracker.registration.table_from_tracker.translation)}
               : std::vector<std::string>{fmt::format("No tracker: tracker.kind is \"{}\"",
                                                      settings::name_of(settings.tracker.kind))};
}

std::vector<std::string> check_words(const settings::Settings& settings) {
    std::vector<std::string> lines{"To check with a ruler",
                                   "x is to the right of a visitor at the front edge, y away from that",
                                   "visitor, both from the middle of the table's top."};
    if (const auto corners = picture_corners(settings.projector)) {
        constexpr std::array names{"top left", "top right", "bottom right", "bottom left"};
        for (std::size_t k = 0; k < corners->size(); ++k) {
            lines.push_back(fmt::format("The picture's {} corner: x {}, y {}", names.at(k),
                                        mm_words((*corners)[k].x), mm_words((*corners)[k].y)));
        }
    }
    lines.push_back(
        fmt::format("Focus on a sheet of paper {} above the table.", mm_words(0.5 * settings.prop.height_m)));
    return lines;
}

} // namespace

glm::dvec2 drawn_place(const settings::LitZone& zone) {
    return zone.any_eye.empty() ? glm::dvec2(0.0) : zone.any_eye_rectangle.centre_m;
}

std::optional<std::array<glm::dvec2, 4>> picture_corners(const settings::ProjectorSettings& projector) {
    const geometry::Pinhole& pinhole = projector.pinhole;
    const std::array<glm::dvec2, 4> pixels{glm::dvec2(0, 0), glm::dvec2(pinhole.width, 0),
                                           glm::dvec2(pinhole.width, pinhole.height),
                                           glm::dvec2(0, pinhole.height)};
    std::array<glm::dvec2, 4> corners{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec3 ray = projector.table_from_projector.direction(pinhole.ray(pixels[k]));
        const glm::dvec3& lens = projector.table_from_projector.translation;
        if (ray.z >= 0.0) {
            return std::nullopt;
        }
        corners[k] = glm::dvec2(lens + ray * (lens.z / -ray.z));
    }
    return corners;
}

bool has_tracker_place(const settings::Settings& settings) {
    return settings.tracker.kind == settings::TrackerKind::Usb;
}

TableNotes table_notes(const settings::Settings& settings, const settings::LitZone& zone) {
    const settings::EyeSettings& eye = settings.eye;
    return {.light = {"The projector's light: its picture on the table"},
            .zone = zone_words(settings, zone),
            .eyes = {fmt::format("Visitors' eyes, all around the table: {} to {} from the prop,",
                                 mm_words(eye.nearest_m), mm_words(eye.farthest_m)),
                     fmt::format("at least {:g}\u00b0 above the table", eye.lowest_elevation_deg)},
            .lens = lens_words(settings.projector),
            .eye = {eye.tracked ? "Eyes while no head is tracked:"
                                : "Eyes of the one place that it is drawn for:",
                    place_words(eye.default_m)},
            .tracker = tracker_words(settings),
            .checks = check_words(settings)};
}

} // namespace frustumscreen::drawing
