#include "app/geometry/prop_edges.h"

#include <algorithm>

namespace frustumscreen::geometry {

namespace {

/// Exact comparison: both faces computed the shared corner from equal numbers.
bool has_corner(const PropFace& face, const glm::dvec3& corner) {
    return std::find(face.corners.begin(), face.corners.end(), corner) != face.corners.end();
}

} // namespace

const PropFace* neighbour_of(const PropShape& prop, const PropFace& face, std::size_t k) {
    for (const PropFace& other : prop.faces) {
        if (&other != &face && has_corner(other, face.corners[k]) &&
            has_corner(other, face.corners[face.corners.next(k)])) {
            return &other;
        }
    }
    return nullptr;
}

} // namespace frustumscreen::geometry
