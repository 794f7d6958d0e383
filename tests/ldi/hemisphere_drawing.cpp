#include "tests/ldi/hemisphere_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::ldi {

namespace {

constexpr double radius = 80.0;
constexpr double middle = 90.0;

struct Place {
    double x = 0.0, y = 0.0;
};
Place place_of(const glm::dvec3& direction) {
    return {middle + radius * direction.x, middle - radius * direction.y};
}
Place place_at(double polar_rad, double azimuth_rad) {
    return place_of(
        {std::sin(polar_rad) * std::cos(azimuth_rad), std::sin(polar_rad) * std::sin(azimuth_rad), 0.0});
}

std::string text(const Place& place, int size, const std::string& words) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" font-family=\"sans-serif\" "
                       "text-anchor=\"middle\" fill=\"#333333\">{}</text>\n",
                       place.x, place.y, size, words);
}

std::string ring_patch(const PatchDirections& patch, const char* fill) {
    const double from = patch.middle_azimuth_rad - patch.half_width_rad;
    const double to = patch.middle_azimuth_rad + patch.half_width_rad;
    const Place a = place_at(patch.min_polar_rad, from);
    const Place b = place_at(patch.max_polar_rad, from);
    const Place c = place_at(patch.max_polar_rad, to);
    const Place d = place_at(patch.min_polar_rad, to);
    const double outer = radius * std::sin(patch.max_polar_rad);
    const double inner = radius * std::sin(patch.min_polar_rad);
    return fmt::format(
        "<path d=\"M{:.2f} {:.2f} L{:.2f} {:.2f} A{:.2f} {:.2f} 0 0 0 {:.2f} {:.2f} L{:.2f} {:.2f} "
        "A{:.2f} {:.2f} 0 0 1 {:.2f} {:.2f} Z\" fill=\"{}\" stroke=\"#888888\" "
        "stroke-width=\"0.4\"/>\n",
        a.x, a.y, b.x, b.y, outer, outer, c.x, c.y, d.x, d.y, inner, inner, a.x, a.y, fill);
}

/// A patch that sees is shown with its cameras: those that it shares are rings.
std::string camera_dot(const Hemisphere& hemisphere, std::size_t number) {
    constexpr std::size_t shown = 2;
    const auto own = hemisphere.own_cameras_of(shown);
    const auto seeing = hemisphere.cameras_of(shown);
    const bool is_own = std::find(own.begin(), own.end(), number) != own.end();
    const bool sees = std::find(seeing.begin(), seeing.end(), number) != seeing.end();
    const Place place = place_of(glm::normalize(hemisphere.cameras()[number]));
    return fmt::format(
        "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"1.8\" fill=\"{}\" stroke=\"{}\" stroke-width=\"0.8\"/>\n",
        place.x, place.y,
        is_own ? "#c04000"
        : sees ? "#ffffff"
               : "#555555",
        sees ? "#c04000" : "#555555");
}

} // namespace

std::string svg_of(const Hemisphere& hemisphere) {
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 180 190\" width=\"540\" height=\"570\">\n"
        "<rect width=\"180\" height=\"190\" fill=\"#ffffff\"/>\n";
    svg += fmt::format(
        "<circle cx=\"{0}\" cy=\"{0}\" r=\"{1}\" fill=\"none\" stroke=\"#888888\" stroke-width=\"0.4\" "
        "stroke-dasharray=\"2 1\"/>\n",
        middle, radius);
    for (std::size_t patch = 1; patch < patch_count; ++patch) {
        svg += ring_patch(hemisphere.directions_of(patch), patch == 2       ? "#ffe0c0"
                                                           : patch % 2 == 0 ? "#e4ecf4"
                                                                            : "#f2f6fa");
    }
    svg += fmt::format("<circle cx=\"{0}\" cy=\"{0}\" r=\"{1:.2f}\" fill=\"#e8f0e4\" stroke=\"#888888\" "
                       "stroke-width=\"0.4\"/>\n",
                       middle, radius * std::sin(hemisphere.directions_of(0).max_polar_rad));
    for (std::size_t camera = 0; camera < camera_count; ++camera) {
        svg += camera_dot(hemisphere, camera);
    }
    for (std::size_t patch = 0; patch < patch_count; ++patch) {
        Place place = place_of(hemisphere.middle_of(patch));
        place.x += patch == 0 ? 5.0 : 0.0;
        place.y += patch == 0 ? -2.0 : 2.0;
        svg += text(place, 6, std::to_string(patch));
    }
    svg += text({middle, 179.0}, 5, "the viewers' side");
    svg += text({middle, 187.0}, 5,
                "dots: cameras; patch 2 sees by its own three and by three of its neighbours");
    return svg + "</svg>\n";
}

} // namespace frustumscreen::ldi
