#include "app/visitor/head_zone.h"

#include "app/geometry/table_plane.h"

#include <cmath>

namespace frustumscreen::visitor {

namespace {

constexpr double nearest_m = 0.15; ///< of a head from the camera
constexpr double farthest_m = 3.0;
constexpr double step_m = 0.05;

Shows what_ray_shows(const HeadZone& zone, const glm::dvec3& origin, const glm::dvec3& direction) {
    for (double away = nearest_m; away < farthest_m; away += step_m) {
        if (zone.holds(origin + away * direction)) {
            return Shows::Head;
        }
    }
    const std::optional<glm::dvec2> meets = geometry::meets_table(origin, direction);
    return meets && zone.outside_m(glm::dvec3(*meets, 0.0)) < 0.0 ? Shows::Table : Shows::Neither;
}

} // namespace

double HeadZone::outside_m(const glm::dvec3& point_m) const {
    const glm::dvec2 beyond = glm::abs(glm::dvec2(point_m)) - 0.5 * table_size_m;
    const double inside = std::fmin(0.0, std::fmax(beyond.x, beyond.y));
    return inside + glm::length(glm::max(beyond, glm::dvec2(0.0)));
}

bool HeadZone::holds(const glm::dvec3& point_m) const {
    const double outside = outside_m(point_m);
    return outside > 0.0 && outside < farthest_m && point_m.z > lowest_m && point_m.z < highest_m;
}

std::vector<Shows> what_pixels_show(const HeadZone& zone, const geometry::Pinhole& camera,
                                    const geometry::RigidTransform& table_from_camera) {
    std::vector<Shows> shows;
    shows.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
    for (int row = 0; row < camera.height; ++row) {
        for (int column = 0; column < camera.width; ++column) {
            const glm::dvec3 ray = glm::normalize(camera.ray({column + 0.5, row + 0.5}));
            shows.push_back(
                what_ray_shows(zone, table_from_camera.translation, table_from_camera.direction(ray)));
        }
    }
    return shows;
}

} // namespace frustumscreen::visitor
