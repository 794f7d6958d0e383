#include "app/bench/setup/zones_by_throw.h"

#include "app/bench/setup/advice.h"

#include <fmt/format.h>

namespace frustumscreen::bench {

std::vector<ThrowZone> zones_by_throw(const settings::Settings& settings,
                                      std::span<const double> throw_ratios) {
    std::vector<ThrowZone> zones;
    for (const double throw_ratio : throw_ratios) {
        settings::Settings zoomed = settings;
        geometry::Pinhole& pinhole = zoomed.projector.pinhole;
        const double zoom = throw_ratio * pinhole.width / pinhole.fx;
        pinhole.fx *= zoom;
        pinhole.fy *= zoom;
        const double distance_m = glm::length(zoomed.projector.table_from_projector.translation);
        const SetUpFigures figures = examine(zoomed);
        zones.push_back(
            {.throw_ratio = throw_ratio,
             .picture_m = {distance_m * pinhole.width / pinhole.fx, distance_m * pinhole.height / pinhole.fy},
             .zone_m = figures.zone_m,
             .pixels = figures.pixels,
             .pixels_a_metre = pinhole.fx / distance_m});
    }
    return zones;
}

std::string zones_csv(std::span<const ThrowZone> zones) {
    std::string csv = "throw_ratio,picture_width_m,picture_depth_m,zone_width_m,zone_depth_m,pixels,"
                      "pixels_a_metre\n";
    for (const ThrowZone& zone : zones) {
        csv += fmt::format("{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.1f},{:.1f}\n", zone.throw_ratio,
                           zone.picture_m.x, zone.picture_m.y, zone.zone_m.x, zone.zone_m.y, zone.pixels,
                           zone.pixels_a_metre);
    }
    return csv;
}

std::string zones_table(std::span<const ThrowZone> zones) {
    std::string table = fmt::format("{:>12}{:>14}{:>14}{:>22}{:>14}\n", "throw ratio", "picture, cm",
                                    "zone, cm", "pixels on the artifact", "pixels a mm");
    for (const ThrowZone& zone : zones) {
        const auto size = [](const glm::dvec2& size_m) {
            return fmt::format("{:.0f} x {:.0f}", 1e2 * size_m.x, 1e2 * size_m.y);
        };
        table +=
            fmt::format("{:>12.3f}{:>14}{:>14}{:>22.0f}{:>14.2f}\n", zone.throw_ratio, size(zone.picture_m),
                        size(zone.zone_m), zone.pixels, 1e-3 * zone.pixels_a_metre);
    }
    return table;
}

} // namespace frustumscreen::bench
