#include "app/programs/frustumscreen/drawing/setup_page.h"

#include "app/settings/light_range.h"
#include "app/settings/lit_zone.h"
#include "app/typography/caption_image.h"
#include "app/typography/captions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace frustumscreen::programs {

namespace {

constexpr double mm = 1e3;           ///< millimetres in a metre
constexpr double min_contrast = 7.0; ///< WCAG 2.2, 1.4.6
/// The projector's dark level plus the room's light on the table, as a share of its white; WCAG assumes this much. No
/// setting has it.
constexpr double assumed_black = 0.05;

/// Intersection of a pixel's ray with a plane of the table's frame; nothing if the ray goes away from the plane.
std::optional<glm::dvec3> meets(const settings::ProjectorSettings& projector, const glm::dvec2& pixel,
                                const geometry::Plane& plane) {
    const geometry::RigidTransform& pose = projector.table_from_projector;
    const glm::dvec3 ray = pose.direction(projector.pinhole.ray(pixel));
    const double toward = -glm::dot(plane.normal, ray);
    return toward > 0.0 ? std::optional(pose.translation + ray * (plane.distance(pose.translation) / toward))
                        : std::nullopt;
}

std::string place_words(const glm::dvec2& place) {
    const auto rounded = [](double metres) { return std::round(1e3 * metres) / 1e3 + 0.0; }; // never -0
    return fmt::format("x {:.3f}, y {:.3f} m", rounded(place.x), rounded(place.y));
}

/// The two sides, in metres, of a projector's pixel at `point` of `plane`, the shorter first.
std::optional<glm::dvec2> pixel_size(const settings::ProjectorSettings& projector, const glm::dvec3& point,
                                     const geometry::Plane& plane) {
    const std::optional<glm::dvec2> pixel =
        projector.pinhole.pixel(projector.table_from_projector.inverse().point(point));
    if (!pixel) {
        return std::nullopt;
    }
    glm::dvec2 sides(0.0);
    for (int axis = 0; axis < 2; ++axis) {
        glm::dvec2 half(0.0);
        half[axis] = 0.5;
        const auto low = meets(projector, *pixel - half, plane);
        const auto high = meets(projector, *pixel + half, plane);
        if (!low || !high) {
            return std::nullopt;
        }
        sides[axis] = glm::distance(*low, *high);
    }
    return glm::dvec2(std::min(sides.x, sides.y), std::max(sides.x, sides.y));
}

std::string sides_in_mm(const glm::dvec2& sides) {
    constexpr double alike = 1.05;
    return sides.y <= alike * sides.x ? fmt::format("{:.3g} mm", mm * sides.x)
                                      : fmt::format("{:.3g} x {:.3g} mm", mm * sides.x, mm * sides.y);
}

/// The prop upright at a place of the table: its faces in the table's frame, and the light that each receives.
class StandingProp {
public:
    StandingProp(const settings::Settings& settings, const glm::dvec2& place, double yaw)
        : prop_(settings::make_prop(settings.prop)),
          lens_(settings.projector.table_from_projector.translation),
          table_from_prop_{glm::angleAxis(yaw, glm::dvec3(0.0, 0.0, 1.0)), glm::dvec3(place, 0.0)} {}

    [[nodiscard]] const std::vector<geometry::PropFace>& faces() const { return prop_.faces; }
    [[nodiscard]] glm::dvec3 centre(const geometry::PropFace& face) const {
        return table_from_prop_.point(face.middle());
    }
    [[nodiscard]] geometry::Plane plane(const geometry::PropFace& face) const {
        const glm::dvec3 normal = table_from_prop_.direction(face.plane.normal);
        return {normal, glm::dot(normal, centre(face))};
    }
    /// Light at the face's centre; 0 if it faces away from the lens.
    [[nodiscard]] double light(const geometry::PropFace& face) const {
        return std::max(0.0, settings::received_light(plane(face), centre(face), lens_));
    }
    /// Light of the dimmest side divided by that of the brightest face.
    [[nodiscard]] double evenness() const {
        double dimmest = std::numeric_limits<double>::infinity();
        double brightest = 0.0;
        for (const geometry::PropFace& face : prop_.faces) {
            if (is_underside(face)) {
                continue;
            }
            dimmest = std::min(dimmest, light(face));
            brightest = std::max(brightest, light(face));
        }
        return brightest > 0.0 ? dimmest / brightest : 0.0;
    }
    [[nodiscard]] static bool is_underside(const geometry::PropFace& face) {
        constexpr double down = -1.0 + 1e-9;
        return face.plane.normal.z < down;
    }

private:
    geometry::PropShape prop_;
    glm::dvec3 lens_;
    geometry::RigidTransform table_from_prop_;
};

/// The range of light over a rectangle of places and all yaws.
settings::LightRange light_over(const settings::Settings& settings, const settings::Rectangle& places) {
    return settings::light_range(settings::make_prop(settings.prop),
                                 settings.projector.table_from_projector.translation -
                                     glm::dvec3(places.centre_m, 0.0),
                                 places.half_m);
}

std::string describe_projector(const settings::Settings& settings) {
    const settings::ProjectorSettings& projector = settings.projector;
    const glm::dvec3& lens = projector.table_from_projector.translation;
    const glm::dvec3 axis = projector.table_from_projector.direction({0.0, 0.0, 1.0});
    return fmt::format(
        "The projector\n"
        "  Its lens is {:.3f} m above the table, {:.3f} m to the right of the table's centre and {:.3f} m "
        "behind it\n"
        "  (negative: left, in front), and looks {:.1f} degrees away from straight down.\n"
        "  Set it to {} x {} pixels at {:g} Hz, without zoom, keystone or other correction of its own.\n",
        lens.z, lens.x, lens.y, glm::degrees(std::acos(std::clamp(-axis.z, -1.0, 1.0))),
        projector.pinhole.width, projector.pinhole.height, projector.refresh_hz);
}

double caption_em_m(const settings::Settings& settings) {
    return std::max(settings.exhibit.caption_height_m, typography::min_caption_em_m);
}

/// Describes captions that are hard to read; empty if size and contrast are sufficient.
std::string describe_captions(const settings::Settings& settings) {
    const settings::ExhibitSettings& exhibit = settings.exhibit;
    if (!exhibit.captions) {
        return "";
    }
    std::string text;
    if (exhibit.caption_height_m < typography::min_caption_em_m) {
        text += fmt::format(
            "  exhibit.caption_height_m, {:.3g} mm, is less than 24 pt: captions are set at 24 pt, "
            "{:.3g} mm.\n",
            mm * exhibit.caption_height_m, mm * typography::min_caption_em_m);
    }
    const double contrast =
        (typography::caption_text_brightness * exhibit.caption_brightness + assumed_black) / assumed_black;
    if (contrast < min_contrast) {
        text +=
            fmt::format("  exhibit.caption_brightness, {:g}: a caption's text has a contrast of {:.1f}:1 "
                        "with the table, and needs "
                        "7:1, from {:.3g} on, if the projector's black and the room's light are {:g} % of "
                        "its white; measure "
                        "these.\n",
                        exhibit.caption_brightness, contrast,
                        (min_contrast - 1.0) * assumed_black / typography::caption_text_brightness,
                        100.0 * assumed_black);
    }
    return text;
}

std::string describe_picture(const settings::Settings& settings) {
    const settings::ProjectorSettings& projector = settings.projector;
    const geometry::Plane table_top{{0.0, 0.0, 1.0}, 0.0};
    const double share = settings::area_of(settings::picture_on_table(settings, 0.0)) /
                         (settings.table.width_m * settings.table.depth_m);
    const glm::dvec2 corner(projector.pinhole.width, projector.pinhole.height);
    std::string text = "The picture on the table\n";
    constexpr std::array<std::pair<const char*, glm::dvec2>, 4> corners{
        {{"top left", {0, 0}}, {"top right", {1, 0}}, {"bottom left", {0, 1}}, {"bottom right", {1, 1}}}};
    for (const auto& [name, at] : corners) {
        const auto place = meets(projector, at * corner, table_top);
        text += place ? fmt::format("  Its {} corner is at {}.\n", name, place_words(glm::dvec2(*place)))
                      : fmt::format("  Its {} corner never meets the table's plane.\n", name);
    }
    text += fmt::format("  It covers {:.0f} % of the table of {:g} x {:g} m.\n", 100.0 * share,
                        settings.table.width_m, settings.table.depth_m);
    if (const auto middle = meets(projector, 0.5 * corner, table_top)) {
        if (const auto size = pixel_size(projector, *middle, table_top)) {
            text += fmt::format(
                "  One projector pixel is {} on the table, in the picture's middle; a caption's letters "
                "are {:.0f} pixels high.\n",
                sides_in_mm(*size), caption_em_m(settings) / size->x);
        }
    }
    return text + describe_captions(settings);
}

/// "+X, -X: ...": one line for each group of equal faces.
std::string describe_faces(const settings::Settings& settings, const StandingProp& prop) {
    double brightest = 0.0;
    for (const geometry::PropFace& face : prop.faces()) {
        brightest = std::max(brightest, prop.light(face));
    }
    std::vector<std::pair<std::string, std::string>> lines; // names, words
    for (const geometry::PropFace& face : prop.faces()) {
        const auto size = pixel_size(settings.projector, prop.centre(face), prop.plane(face));
        const bool lit = size && prop.light(face) > 0.0;
        const std::string words =
            lit ? fmt::format("one pixel is {}; the light is {:.2f} of the brightest face's",
                              sides_in_mm(*size), prop.light(face) / brightest)
                : std::string("no light");
        const auto same =
            std::find_if(lines.begin(), lines.end(), [&](const auto& line) { return line.second == words; });
        if (same != lines.end()) {
            same->first += fmt::format(", {}", face.name);
        } else {
            lines.emplace_back(face.name, words);
        }
    }
    std::string text;
    for (const auto& [names, words] : lines) {
        text += fmt::format("  {}: {}.\n", names, words);
    }
    return text;
}

std::string describe_prop(const settings::Settings& settings, const glm::dvec2& place) {
    const StandingProp prop(settings, place, 0.0);
    const double evenness = prop.evenness();
    return fmt::format("The prop on the table at {}, its faces square to the table\n", place_words(place)) +
           describe_faces(settings, prop) +
           (evenness > 0.0 ? fmt::format("  Faces are lit 1 : {:.2f}.\n", evenness) : std::string());
}

std::string words_of(const settings::Rectangle& inside) {
    const glm::dvec2 low = inside.centre_m - inside.half_m;
    const glm::dvec2 high = inside.centre_m + inside.half_m;
    return fmt::format("x {:.3f} to {:.3f} m, y {:.3f} to {:.3f} m", low.x, high.x, low.y, high.y);
}

/// The part of `zone`, about its middle, in which every place of the prop can reflect the light that the exhibit aims
/// at; nothing if the middle fails.
std::optional<settings::Rectangle> evenly_lit(const settings::Settings& settings,
                                              const settings::Rectangle& zone) {
    constexpr double rounding = 1e-3;
    const double aim = (1.0 - rounding) * settings::even_light(settings);
    const auto part = [&](double share) { return settings::Rectangle{zone.centre_m, share * zone.half_m}; };
    const auto even = [&](double share) { return light_over(settings, part(share)).least >= aim; };
    if (!even(0.0)) {
        return std::nullopt;
    }
    double inside = 0.0;
    double outside = 1.0;
    for (int halving = 0; halving < 10 && !even(1.0); ++halving) {
        const double between = 0.5 * (inside + outside);
        (even(between) ? inside : outside) = between;
    }
    return part(even(1.0) ? 1.0 : inside);
}

/// A prop in the hand has no preferred turn and no face that is always lit.
std::string describe_hand_zone(const settings::LitZone& zone) {
    return zone.any_eye.empty()
               ? std::string("The prop inside the picture\n  There is no place where it stays inside at "
                             "every turn: hang the projector higher, or take a smaller prop.\n")
               : fmt::format("The prop inside the picture\n  At every turn while its middle is within {},\n  "
                             "the largest rectangle in a zone of {:.3f} m2.\n",
                             words_of(zone.any_eye_rectangle), settings::area_of(zone.any_eye));
}

std::string describe_table_zone(const settings::Settings& settings, const settings::LitZone& zone) {
    std::string text = "The prop lit at every turn, by the place of its axis\n";
    if (zone.any_eye.empty()) {
        text += "  Nowhere for eyes all around: hang the projector higher and more over the table, or take a "
                "flatter prop.\n";
    } else {
        const settings::Rectangle& inside = zone.any_eye_rectangle;
        text += fmt::format("  For eyes all around: {}, the largest rectangle in a zone of {:.3f} m2.\n",
                            words_of(inside), settings::area_of(zone.any_eye));
        const std::optional<settings::Rectangle> even = evenly_lit(settings, inside);
        text += even ? fmt::format("  It stays evenly lit within {}.\n", words_of(*even))
                     : std::string("  It is evenly lit nowhere: its sides are too steep for this light.\n");
        text += fmt::format(
            "  Faces are lit 1 : {:.2f} at the worst turn in the worst corner of the first rectangle.\n",
            std::max(0.0, light_over(settings, inside).evenness));
    }
    return text + fmt::format("  For the eyes at eye.default_m alone: a zone of {:.3f} m2.\n",
                              std::abs(settings::area_of(zone.default_eye)));
}

std::string describe_zone(const settings::Settings& settings, const settings::LitZone& zone) {
    return settings.prop.zone == settings::PropZone::Hand ? describe_hand_zone(zone)
                                                          : describe_table_zone(settings, zone);
}

/// Distance between two planes square to the optical axis that enclose everything that is lit.
std::string describe_focus(const settings::Settings& settings, const settings::Rectangle& zone) {
    const geometry::RigidTransform projector_from_table = settings.projector.table_from_projector.inverse();
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec2 sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0);
        const glm::dvec3 point(zone.centre_m + sign * zone.half_m,
                               (corner & 4) != 0 ? settings.prop.height_m : 0.0);
        const double depth = projector_from_table.point(point).z;
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    return fmt::format(
        "  Focus: what is lit lies {:.2f} to {:.2f} m in front of the lens. Focus on a sheet held {:.0f} mm "
        "above the table.\n",
        nearest, farthest, 0.5 * mm * settings.prop.height_m);
}

std::string describe_errors(const settings::Settings& settings, const settings::Rectangle& zone) {
    const settings::ProjectorSettings& projector = settings.projector;
    const glm::dvec3 point(zone.centre_m, settings.prop.height_m);
    const glm::dvec3& lens = projector.table_from_projector.translation;
    const double distance = glm::distance(lens, point);
    const double pixel_m = projector.table_from_projector.inverse().point(point).z /
                           std::max(projector.pinhole.fx, projector.pinhole.fy);
    const double tenth_degree_m = glm::radians(0.1) * distance;
    const double shift = settings.prop.height_m / (lens.z - settings.prop.height_m);
    const double walk_m = 1e-3 * settings.tracker.display_latency_ms * 0.3;
    return fmt::format(
        "The effect of errors\n{}"
        "  A projector turned by 0.1 degrees: {:.1f} mm on the prop's top, {:.1f} pixels.\n"
        "  A lens 10 mm from its place, with the picture aligned on the table: {:.1f} mm on the top.\n"
        "  A tracker error of 1 mm: {:.1f} pixels. Artifacts are drawn to {:g} pixels, {:.2f} mm.\n"
        "  tracker.display_latency_ms, {:g} ms: a prop slid at 0.3 m/s moves {:.1f} mm meanwhile; this is "
        "predicted.\n",
        describe_focus(settings, zone), mm * tenth_degree_m, tenth_degree_m / pixel_m, 10.0 * shift,
        1e-3 / pixel_m, settings.render.error_tolerance_px, mm * settings.render.error_tolerance_px * pixel_m,
        settings.tracker.display_latency_ms, mm * walk_m);
}

} // namespace

std::string setup_page(const settings::Settings& settings) {
    const settings::LitZone zone = settings::lit_zone(settings);
    const settings::Rectangle& inside = zone.any_eye_rectangle;
    return describe_projector(settings) + describe_picture(settings) +
           describe_prop(settings, inside.centre_m) + describe_zone(settings, zone) +
           describe_errors(settings, inside);
}

} // namespace frustumscreen::programs
