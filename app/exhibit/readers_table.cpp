#include "app/exhibit/readers_table.h"

#include "app/settings/polygon.h"
#include "app/typography/visitor_side.h"

#include <limits>
#include <numbers>

namespace frustumscreen::exhibit {

namespace {

constexpr double border_m = 0.008; ///< to the picture's edge

} // namespace

ReadersTable::ReadersTable(const TableSetUp& set_up, int quarter_turns)
    : home(typography::turned(set_up.home_m, -quarter_turns)) {
    settings::Polygon picture;
    for (const glm::dvec2& corner : set_up.picture_m) {
        picture.push_back(typography::turned(corner, -quarter_turns));
    }
    const settings::Rectangle inside =
        picture.size() >= 3 ? settings::rectangle_inside(picture) : settings::Rectangle{};
    inner = {inside.centre_m, inside.half_m - border_m};
    usable = inner.half.x > 0.0 && inner.half.y > 0.0 && !set_up.prop.corners.empty();
    const glm::dvec2 lens = typography::turned(glm::dvec2(set_up.lens_m), -quarter_turns);
    reach.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < direction_count; ++k) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / direction_count;
        directions[k] = {std::cos(angle), std::sin(angle)};
    }
    for (const glm::dvec3& corner : set_up.prop.corners) {
        usable = usable && corner.z < 0.99 * set_up.lens_m.z;
        const double larger = set_up.lens_m.z / (set_up.lens_m.z - corner.z);
        const glm::dvec2 middle = lens + larger * (home - lens);
        const double radius = larger * glm::length(glm::dvec2(corner));
        for (std::size_t k = 0; k < direction_count; ++k) {
            reach[k] = std::max(reach[k], glm::dot(directions[k], middle) + radius);
        }
        home_radius = std::max(home_radius, radius);
    }
    hidden_around_home = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < direction_count; ++k) {
        hidden_around_home = std::min(hidden_around_home, reach[k] - glm::dot(directions[k], home));
    }
}

/// Separating-axis test. The directions are the normals of all edges, including the area's, which mostly decide and
/// come first.
bool ReadersTable::is_clear_of_home(const TableArea& area, double margin) const {
    if (glm::distance(area.centre, home) < hidden_around_home + margin) {
        return false;
    }
    constexpr std::size_t quarter = direction_count / 4;
    for (std::size_t step = 0; step < direction_count; ++step) {
        const std::size_t k = step % 4 * quarter + step / 4;
        const double nearest =
            glm::dot(directions[k], area.centre) - glm::dot(glm::abs(directions[k]), area.half);
        if (nearest >= reach[k] + margin) {
            return true;
        }
    }
    return false;
}

} // namespace frustumscreen::exhibit
