/// The convex hull of points in a plane.
///
/// Frame    any, of two axes.
/// Threads  pure; any. Allocates nothing.
/// Method   the monotone chain (Andrew 1979).
#pragma once

#include <glm/glm.hpp>

#include <span>

namespace frustumscreen::geometry {

/// Counter-clockwise, where y is up. Sorts `points`; the result lies in `chain`, which has space for one point more.
/// The hull of one point or none is empty.
[[nodiscard]] std::span<const glm::dvec2> planar_hull(std::span<glm::dvec2> points,
                                                      std::span<glm::dvec2> chain);

} // namespace frustumscreen::geometry
