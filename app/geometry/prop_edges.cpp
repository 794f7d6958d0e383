#include "app/geometry/prop_edges.h"

#include <algorithm>

namespace frustumscreen {

namespace {

/// Both were computed from the same numbers, so that a shared corner is equal.
bool has_corner(const PropFace& face, const glm::dvec3& corner) {
    return std::find(face.corners.begin(), face.corners.end(), corner) != face.corners.end();
}

} // namespace

const PropFace* neighbour_of(const PropShape& prop, const PropFace& face, std::size_t k) {
    for (const PropFace& other : prop.faces) {
        if (&other != &face && has_corner(other, face.corners.at(k)) &&
            has_corner(other, face.corners.at((k + 1) % 4))) {
            return &other;
        }
    }
    return nullptr;
}

} // namespace frustumscreen
