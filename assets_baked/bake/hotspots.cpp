#include "assets_baked/bake/hotspots.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace frustumscreen::bake {

namespace {

constexpr float golden_angle = 2.3999632F;
constexpr float off_surface_box = 2e-4F; ///< more than the rounding error of 32-bit rays at the surface

/// Two unit vectors perpendicular to `normal` and to each other.
std::pair<glm::vec3, glm::vec3> across(const glm::vec3& normal) {
    const glm::vec3 other = std::abs(normal.x) < 0.7F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 u = glm::normalize(glm::cross(normal, other));
    return {u, glm::cross(normal, u)};
}

/// Number of directions, spread evenly over the hemisphere about `normal`, that lead from the point out of
/// the artifact into the viewing zone.
int open_directions(const SourceScene& source, const glm::vec3& point, const glm::vec3& normal,
                    const ViewingZone& zone) {
    constexpr int directions = 96;
    const auto lowest = static_cast<float>(std::sin(zone.lowest_elevation_deg * std::numbers::pi / 180.0));
    const auto [u, v] = across(normal);
    const glm::vec3 origin = point + normal * off_surface_box;
    int open = 0;
    for (int k = 0; k < directions; ++k) {
        const float along = (static_cast<float>(k) + 0.5F) / directions;
        const float aside = std::sqrt(1.0F - along * along);
        const float angle = golden_angle * static_cast<float>(k);
        const glm::vec3 direction = normal * along + (u * std::cos(angle) + v * std::sin(angle)) * aside;
        if (direction.z >= lowest && !source.occluded(origin, direction, 0.0F, 1e30F)) {
            ++open;
        }
    }
    return open;
}

/// Mean over a small disc, because single triangles of a scan point in random directions.
glm::vec3 mean_normal(const SourceScene& source, const glm::vec3& point, const glm::vec3& normal) {
    constexpr int rays = 48;
    constexpr float radius_box = 0.012F;
    constexpr float above_box = 0.02F;
    const auto [u, v] = across(normal);
    glm::vec3 sum = normal;
    for (int k = 0; k < rays; ++k) {
        const float out = radius_box * std::sqrt((static_cast<float>(k) + 0.5F) / rays);
        const float angle = golden_angle * static_cast<float>(k);
        const glm::vec3 origin =
            point + normal * above_box + (u * std::cos(angle) + v * std::sin(angle)) * out;
        const SurfaceHit hit = source.trace(origin, -normal, 0.0F, 2.0F * above_box);
        if (hit.hit) {
            sum += glm::dot(hit.normal, normal) < 0.0F ? -hit.normal : hit.normal;
        }
    }
    return glm::normalize(sum);
}

/// The nearest point on a triangle with an area; a triangle without one has no normal.
SurfaceHit nearest_with_normal(const SourceScene& source, const glm::vec3& point) {
    constexpr float reach_box = 1e6F;
    constexpr float aside_box = 1e-3F;
    SurfaceHit hit = source.nearest(point, reach_box);
    for (int k = 0; k < 6 && hit.hit && hit.normal == glm::vec3(0.0F); ++k) {
        glm::vec3 aside(0.0F);
        aside[k / 2] = k % 2 == 0 ? aside_box : -aside_box;
        hit = source.nearest(point + aside, reach_box);
    }
    return hit;
}

std::string words_of(const glm::dvec3& v) {
    return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x, v.y, v.z);
}

std::string in_sizes(double distance_box) {
    return distance_box < 1.0 ? fmt::format("{:.1f} % of the artifact's size", 100.0 * distance_box)
                              : fmt::format("{:.0f} times the artifact's size", distance_box);
}

} // namespace

Result<pack::PackHotspot> put_on_surface(const GivenHotspot& given, const SourceScene& source,
                                         const BoxFrame& frame, const ViewingZone& zone) {
    const glm::dvec3 wanted(frame.box_from_file * glm::dvec4(given.point_file, 1.0));
    const SurfaceHit nearest = nearest_with_normal(source, glm::vec3(wanted));
    if (!nearest.hit || nearest.normal == glm::vec3(0.0F)) {
        return bad_input("hotspot.no_surface",
                         "{} is {}; the surface next to it could not be found, choose another point",
                         given.place, words_of(given.point_file));
    }
    const double distance = glm::distance(glm::dvec3(nearest.point), wanted);
    const glm::dvec3 nearest_file(glm::inverse(frame.box_from_file) * glm::dvec4(nearest.point, 1.0F));
    if (!(distance <= max_hotspot_distance_box)) {
        return bad_input("hotspot.away_from_surface",
                         "{} is {}, which is {} away from its surface; allowed are {:g} % of that size; the "
                         "nearest point of it is {}",
                         given.place, words_of(given.point_file), in_sizes(distance),
                         100.0 * max_hotspot_distance_box, words_of(nearest_file));
    }
    const int front = open_directions(source, nearest.point, nearest.normal, zone);
    const int back = open_directions(source, nearest.point, -nearest.normal, zone);
    if (front == 0 && back == 0) {
        return bad_input("hotspot.hidden",
                         "{} is {}, where no visitor can see the artifact's surface; choose a point "
                         "that is open to the side or to above",
                         given.place, words_of(given.point_file));
    }
    const glm::vec3 outward = back > front ? -nearest.normal : nearest.normal;
    return pack::PackHotspot{glm::dvec3(nearest.point),
                             glm::normalize(glm::dvec3(mean_normal(source, nearest.point, outward))),
                             given.labels};
}

} // namespace frustumscreen::bake
