/// Corners of a convex solid that holds a cloud of points: their convex hull or, where that has too many corners, one that is
/// hardly larger.
///
/// Frame    that of the points.
/// Threads  pure; any.
/// Method   quickhull (Barber, Dobkin, Huhdanpaa 1996), the farthest point of all first. Where it is ended early, some points
///          lie a little outside; the solid is then scaled about its middle until it holds them.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen {

/// `most`: corners, at least 8. Points on a plane or a line give a solid that is next to flat.
[[nodiscard]] std::vector<glm::dvec3> enclosing_corners(std::span<const glm::dvec3> points, std::size_t most);

} // namespace frustumscreen
