/// Convex polygons on the table.
///
/// Frames   table T, metres; corners counter-clockwise; an empty polygon has none.
/// Threads  pure; any.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::settings {

using Polygon = std::vector<glm::dvec2>;

/// The points x with inward.x >= offset.
struct HalfPlane {
    glm::dvec2 inward{0.0};
    double offset = 0.0;
};

[[nodiscard]] Polygon clipped(const Polygon& polygon, const HalfPlane& keep);

/// The smallest convex polygon that holds the points (geometry/planar_hull.h).
[[nodiscard]] Polygon convex_polygon(std::vector<glm::dvec2> points);

[[nodiscard]] double area_of(const Polygon& polygon);

struct Rectangle {
    glm::dvec2 centre_m{0.0};
    glm::dvec2 half_m{0.0}; ///< along X and Y; zero if there is none
};
/// The largest rectangle along the axes about the polygon's centroid.
[[nodiscard]] Rectangle rectangle_inside(const Polygon& polygon);

} // namespace frustumscreen::settings
