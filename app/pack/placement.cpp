#include "app/pack/pack_file.h"
#include "app/pack/pack_hull.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace frustumscreen::pack {

namespace {

/// The extremes are the artifact's outlines seen along x and along y, so they hold for planes that are parallel to one
/// of these axes: all those of a frustum and a cube.
bool is_bounded_by_extremes(const geometry::PropShape& prop) {
    constexpr double rounding = 1e-12;
    return std::all_of(prop.bounds.begin(), prop.bounds.end(), [](const geometry::Plane& bound) {
        return std::abs(bound.normal.x) <= rounding || std::abs(bound.normal.y) <= rounding;
    });
}

std::vector<glm::dvec3> outermost(const PackDescription& pack, const geometry::PropShape& prop) {
    if (is_bounded_by_extremes(prop)) {
        return pack.extremes;
    }
    return hull_of(pack).value_or(corners_of_box(pack));
}

} // namespace

Placement place(const PackDescription& pack, const geometry::PropShape& prop) {
    // The box stands on z = 0 by definition. Rounding may put a point below; without this, the scale would then
    // become 0.
    std::vector<glm::dvec3> points = outermost(pack, prop);
    for (glm::dvec3& point : points) {
        point.z = std::fmax(point.z, 0.0);
    }
    const double scale = pack.scale * geometry::largest_scale_inside(prop, points);
    return {scale, glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * pack.box_from_file};
}

} // namespace frustumscreen::pack
