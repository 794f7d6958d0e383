/// Whether the visitor's picture is finer than the projector's.
#pragma once

#include "app/simulation/visitor_view.h"

#include <cmath>

namespace frustumscreen::simulation {

/// Pixels per square metre of the plane through `point` with this `normal`, both in the pinhole's frame. A
/// pixel of a pinhole covers Z^3 / (fx fy |n . p|) there, at the point p = (X, Y, Z), and less where the lens
/// enlarges the picture.
[[nodiscard]] inline double pixels_per_square_metre(const geometry::Pinhole& pinhole, const glm::dvec3& point,
                                                    const glm::dvec3& normal) {
    const double z = point.z;
    const double bent = pinhole.lens.area_factor((point.x * point.x + point.y * point.y) / (z * z));
    return pinhole.fx * pinhole.fy * bent * std::abs(glm::dot(normal, point)) / (z * z * z);
}

/// Number of projector pixels covered by one pixel of the visitor, by area, at the surface point that the
/// visitor sees through `pixel`; 0 if that is not a lit face of the prop. Where this is >= 1, the visitor's
/// pixel is no finer than the projector's.
[[nodiscard]] inline double projector_pixels_covered(const VisitorScene& scene, const VisitorCamera& camera,
                                                     const glm::dvec2& pixel) {
    const geometry::RigidTransform prop_from_table = scene.table_from_prop.inverse();
    const geometry::RigidTransform prop_from_camera = prop_from_table * camera.table_from_camera;
    const geometry::RigidTransform prop_from_projector = prop_from_table * scene.table_from_projector;
    const glm::dvec3 eye = prop_from_camera.translation;
    const glm::dvec3 ray = prop_from_camera.direction(camera.pinhole.ray(pixel));
    geometry::PropHit hit;
    if (!geometry::intersect(scene.prop, eye, ray, hit)) {
        return 0.0;
    }
    const geometry::Plane& plane = scene.prop.faces[static_cast<std::size_t>(hit.face)].plane;
    if (plane.distance(prop_from_projector.translation) <= 0.0) {
        return 0.0;
    }
    const auto density = [&](const geometry::Pinhole& pinhole,
                             const geometry::RigidTransform& prop_from_lens) {
        const geometry::RigidTransform lens_from_prop = prop_from_lens.inverse();
        return pixels_per_square_metre(pinhole, lens_from_prop.point(eye + hit.t * ray),
                                       lens_from_prop.direction(plane.normal));
    };
    return density(scene.projector, prop_from_projector) / density(camera.pinhole, prop_from_camera);
}

} // namespace frustumscreen::simulation
