#include "app/solid/solid.h"

#include "app/solid/area_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::solid {

namespace {

/// The distance between the two planes of this normal that hold the solid between them.
double width_along(const Solid& solid, const glm::dvec3& normal) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const glm::dvec3& corner : solid.corners) {
        low = std::fmin(low, glm::dot(normal, corner));
        high = std::fmax(high, glm::dot(normal, corner));
    }
    return high - low;
}

/// Each edge once or twice, unit.
std::vector<glm::dvec3> edge_directions(const Solid& solid) {
    std::vector<glm::dvec3> directions;
    for (const SolidFace& face : solid.faces) {
        for (std::size_t k = 0; k < face.corners.size(); ++k) {
            const glm::dvec3 along = face.corners[(k + 1) % face.corners.size()] - face.corners[k];
            directions.push_back(glm::normalize(along));
        }
    }
    return directions;
}

} // namespace

bool is_underside(const SolidFace& face) {
    return face.plane.normal.z < 0.0 &&
           std::all_of(face.corners.begin(), face.corners.end(),
                       [](const glm::dvec3& corner) { return std::abs(corner.z) <= flatness_m; });
}

double volume_of(const Solid& solid) {
    double volume = 0.0;
    for (const SolidFace& face : solid.faces) {
        const glm::dvec3 to_corner = face.corners.front() - solid.corners.front();
        volume += glm::dot(area_vector(face.corners), to_corner) / 3.0;
    }
    return volume;
}

double area_of(const SolidFace& face) {
    return glm::length(area_vector(face.corners));
}

SolidBox box_around(const Solid& solid) {
    SolidBox box{solid.corners.front(), solid.corners.front()};
    for (const glm::dvec3& corner : solid.corners) {
        box = {glm::min(box.low, corner), glm::max(box.high, corner)};
    }
    return box;
}

SolidWidth min_width(const Solid& solid) {
    SolidWidth best{std::numeric_limits<double>::infinity()};
    const auto look_along = [&](const glm::dvec3& normal) {
        if (const double width = width_along(solid, normal); width < best.width_m) {
            best = {width, normal};
        }
    };
    for (const SolidFace& face : solid.faces) {
        look_along(face.plane.normal);
    }
    const std::vector<glm::dvec3> edges = edge_directions(solid);
    for (std::size_t a = 0; a < edges.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            constexpr double parallel = 1e-9; // sine; other pairs of edges span the same planes
            const glm::dvec3 across = glm::cross(edges[a], edges[b]);
            if (glm::length(across) > parallel) {
                look_along(glm::normalize(across));
            }
        }
    }
    return best;
}

Solid moved(Solid solid, const geometry::RigidTransform& to_from) {
    for (glm::dvec3& corner : solid.corners) {
        corner = to_from.point(corner);
    }
    for (SolidFace& face : solid.faces) {
        for (glm::dvec3& corner : face.corners) {
            corner = to_from.point(corner);
        }
        const glm::dvec3 on_plane = to_from.point(face.plane.offset * face.plane.normal);
        face.plane.normal = to_from.direction(face.plane.normal);
        face.plane.offset = glm::dot(face.plane.normal, on_plane);
    }
    return solid;
}

} // namespace frustumscreen::solid
