/// A polygon's area and normal in one vector.
///
/// Threads  pure; any.
/// Source   Newell, in Sutherland, Sproull, Schumacker, A Characterization of Ten Hidden-Surface Algorithms,
///          1974.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <span>

namespace frustumscreen::solid {

/// Along the normal, as long as the area; of a polygon with three corners or more, counter-clockwise seen
/// against the normal. If the corners are not in one plane, the plane that fits them best on the whole.
[[nodiscard]] inline glm::dvec3 area_vector(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        sum += glm::cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    }
    return 0.5 * sum;
}

} // namespace frustumscreen::solid
