/// The light in the visitor's room: the projector's light and a faint room light.
///
/// A surface reflects its share (albedo) of the projector's light, which falls as cos / d^2, and of the
/// room's. The exposure is fixed by the set-up, like an eye adapted to the room: white on the middle of a
/// side face, with the prop upright at the table's centre, counts as 1. Against the dark grey table of a dark
/// room the artifact is then as bright as it looks to a visitor.
///
/// Frames   table T, metres. Light is linear.
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"

#include <glm/glm.hpp>

#include <algorithm>

namespace frustumscreen::simulation {

inline constexpr double prop_albedo = 0.85;
inline constexpr double table_albedo = 0.40;
inline constexpr double brightest_room_light = 0.045; ///< after exposure, on a surface that faces it

/// cos / d^2 of the projector's light at a point; 0 if it comes from behind.
[[nodiscard]] inline double received_from(const glm::dvec3& lens_m, const glm::dvec3& point_m,
                                          const glm::dvec3& normal) {
    const glm::dvec3 to_light = lens_m - point_m;
    const double distance = glm::length(to_light);
    return std::max(0.0, glm::dot(normal, to_light) / (distance * distance * distance));
}

/// Factor of the projector's light.
[[nodiscard]] inline double exposure_of(const geometry::PropShape& prop, const glm::dvec3& lens_m) {
    const geometry::PropFace& side = prop.faces.front();
    const double light = received_from(lens_m, side.middle(), side.plane.normal);
    return 1.0 / (light > 0.0 ? light : received_from(lens_m, glm::dvec3(0.0), glm::dvec3(0, 0, 1)));
}

[[nodiscard]] inline double room_light_on(const glm::dvec3& normal) {
    const glm::dvec3 from = glm::normalize(glm::dvec3(-0.35, -0.45, 0.82));
    return brightest_room_light * (0.35 + 0.65 * std::max(0.0, glm::dot(normal, from)));
}

} // namespace frustumscreen::simulation
