#include "app/scene/light.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen {

namespace {

/// Sine of the elevation above a face at which the face counts in full.
constexpr double full_sine = 0.2;

double by_degrees(const Plane& face, const glm::dvec3& centre, const glm::dvec3& from) {
    const double sine = face.distance(from) / glm::distance(from, centre);
    return ease(sine / full_sine);
}

glm::dvec3 centre_of(const PropFace& face) {
    return 0.25 * (face.corners[0] + face.corners[1] + face.corners[2] + face.corners[3]);
}

} // namespace

double received_light(const Plane& face, const glm::dvec3& point, const glm::dvec3& projector) {
    const double d = glm::distance(projector, point);
    return face.distance(projector) / (d * d * d);
}

double reference_light(std::span<const SeenFace> seen, const glm::dvec3& projector,
                       const LightCompensation& compensation) {
    double brightest = 0.0;
    for (const SeenFace& s : seen) {
        brightest = std::max(brightest, received_light(s.face->plane, centre_of(*s.face), projector));
    }
    double reference = brightest;
    for (const SeenFace& s : seen) {
        // h is the same all over a face and d is convex: the least light is at a corner.
        double least = std::numeric_limits<double>::infinity();
        for (const glm::dvec3& corner : s.face->corners) {
            least = std::min(least, received_light(s.face->plane, corner, projector));
        }
        least = std::max(least, compensation.least_gain * brightest);
        const glm::dvec3 centre = centre_of(*s.face);
        const double weight =
            by_degrees(s.face->plane, centre, s.eye) * by_degrees(s.face->plane, centre, projector);
        reference = std::min(reference, std::lerp(brightest, least, weight));
    }
    return reference;
}

FaceLight face_light(const Plane& face, const Pinhole& pinhole, const glm::dmat4& projector_from_prop,
                     double reference, const LightCompensation& compensation) {
    // The plane in the projector's frame: m.Q = h with m = R n; with Q = Z r, 1 / Z = m.r / h.
    const glm::dvec3 m = glm::dmat3(projector_from_prop) * face.normal;
    const double h = face.offset + glm::dot(m, glm::dvec3(projector_from_prop[3]));
    const glm::dvec3 per_ray = m / h;
    FaceLight light;
    light.inverse_depth = glm::vec3(
        glm::dvec3(per_ray.x / pinhole.fx, per_ray.y / pinhole.fy,
                   per_ray.z - per_ray.x * pinhole.cx / pinhole.fx - per_ray.y * pinhole.cy / pinhole.fy));
    // `h` is measured from the projector's origin along m: the projector is -h above the plane.
    light.constant = static_cast<float>(1.0 - compensation.strength);
    light.per_cubic_metre = static_cast<float>(compensation.strength * reference / -h);
    return light;
}

double gain(const FaceLight& light, const Pinhole& pinhole, const glm::dvec2& pixel) {
    const double inverse_depth = glm::dot(glm::dvec3(light.inverse_depth), glm::dvec3(pixel, 1.0));
    const double d = glm::length(pinhole.ray(pixel)) / inverse_depth;
    return std::min(1.0, static_cast<double>(light.constant) +
                             static_cast<double>(light.per_cubic_metre) * d * d * d);
}

} // namespace frustumscreen
