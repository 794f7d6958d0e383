/// A point of a face from which distances to the face are measured.
///
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"

namespace frustumscreen::geometry {

/// The middle of a quadrilateral's diagonal. A triangle has no diagonal, so a face with any other number of corners has
/// the mean of its corners.
[[nodiscard]] inline glm::dvec3 inner_point(const PropFace& face) {
    return face.corners.size() == 4 ? 0.5 * (face.corners[0] + face.corners[2]) : face.middle();
}

} // namespace frustumscreen::geometry
