/// Corners of a convex solid that encloses a cloud of points: its convex hull or, if that has too many
/// corners, a solid that is hardly larger.
///
/// Frame    that of the points.
/// Threads  pure; any.
/// Method   quickhull (Barber, Dobkin, Huhdanpaa 1996), the farthest point first. If it stops early, some
///          points lie a little outside; the solid is then scaled about its middle until it encloses them.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen::geometry {

/// `most`: number of corners, at least 8. Points on a plane or a line give a nearly flat solid.
[[nodiscard]] std::vector<glm::dvec3> enclosing_corners(std::span<const glm::dvec3> points, std::size_t most);

} // namespace frustumscreen::geometry
