/// The pose of a projector, from its place and the point on its optical axis.
///
/// Frames   table T, metres; the roll in degrees.
/// Threads  pure; any.
#pragma once

#include "app/geometry/transform.h"

#include <optional>

namespace frustumscreen::settings {

/// The projector at `position` looks at `aim`, with its picture's top towards the table's far side (+Y), turned
/// by `roll_deg` about its axis, clockwise as the projector sees it. Returns nothing if it looks along +-Y or
/// has no direction.
[[nodiscard]] std::optional<geometry::RigidTransform> looking_at(const glm::dvec3& position,
                                                                 const glm::dvec3& aim, double roll_deg);

} // namespace frustumscreen::settings
