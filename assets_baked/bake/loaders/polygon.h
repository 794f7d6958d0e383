/// Cuts a planar polygon into triangles.
///
/// Shape    corners in order; the result's indices refer to the polygon's own corners, orientation kept.
/// Method   a fan if the polygon is convex; otherwise ears are cut off one after the other (Meisters,
///          Polygons have ears, 1975), each tested against the reflex corners alone. Time is proportional to the number
///          of corners times that of reflex corners.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::bake {

/// Appends n - 2 triangles to `triangles`; none for fewer than three corners.
void triangulate_polygon(std::span<const glm::dvec3> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

} // namespace frustumscreen::bake
