/// Distances of a few points from a surface of any number of triangles. Memory grows with the points alone: the points lie
/// in a grid, and the triangles pass by once, or a few times.
///
/// Threads  uses all cores; the result does not depend on their number.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen {

struct SurfaceView {
    std::span<const glm::dvec3> positions;
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// `count` points spread over the surface by area; none for a surface without area.
[[nodiscard]] std::vector<glm::dvec3> points_on(const SurfaceView& surface, std::size_t count);

/// The distance of each point from the surface, which has a triangle. Most points should lie nearer than `usual`, which
/// decides on the time alone.
[[nodiscard]] std::vector<double> distances_to(const SurfaceView& surface, std::span<const glm::dvec3> points,
                                               double usual);

} // namespace frustumscreen
