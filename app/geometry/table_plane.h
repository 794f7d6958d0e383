/// Intersections of rays and of the projector's light with the table, the plane z = 0.
///
/// Frames   table T, +Z up.
/// Units    metres; pixels of the projector's picture.
/// Errors   none: nullopt for a ray that does not go down, or is not a number.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"

#include <optional>

namespace frustumscreen::geometry {

/// `direction`: of any length.
[[nodiscard]] inline std::optional<glm::dvec2> meets_table(const glm::dvec3& origin,
                                                           const glm::dvec3& direction) {
    if (!(direction.z < 0.0)) {
        return std::nullopt;
    }
    return glm::dvec2(origin - direction * (origin.z / direction.z));
}

/// The point of the table that a pixel lights.
[[nodiscard]] inline std::optional<glm::dvec2>
lights_table(const Pinhole& projector, const RigidTransform& table_from_projector, const glm::dvec2& pixel) {
    return meets_table(table_from_projector.translation,
                       table_from_projector.direction(projector.ray(pixel)));
}

} // namespace frustumscreen::geometry
