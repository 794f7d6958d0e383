#include "app/geometry/face_rays.h"

namespace frustumscreen::geometry {

FaceRays face_rays(const PropFace& face, const Pinhole& projector, const RigidTransform& prop_from_projector,
                   const glm::dvec3& eye_m) {
    const glm::dvec3 origin = prop_from_projector.translation;
    const glm::dvec3 corner = prop_from_projector.direction(projector.ray({0.0, 0.0}));
    const glm::dmat3 light(prop_from_projector.direction(projector.ray({1.0, 0.0})) - corner,
                           prop_from_projector.direction(projector.ray({0.0, 1.0})) - corner, corner);
    FaceRays rays;
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
        const glm::dvec3 from = face.corners[k] - origin;
        const glm::dvec3 to = face.corners[face.corners.next(k)] - origin;
        rays.edges.push_back(glm::cross(from, to) * light);
    }
    rays.direction =
        face.plane.distance(origin) * light - glm::outerProduct(origin - eye_m, face.plane.normal * light);
    rays.slant = -(face.plane.normal * light);
    return rays;
}

} // namespace frustumscreen::geometry
