#include "app/scene/light.h"

#include "app/geometry/time_curves.h"
#include "app/settings/light_range.h"
#include "app/settings/lit_zone.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::scene {

namespace {

/// Sine of the eye's elevation above a face at which the face counts fully.
constexpr double full_sine_of_sight = 0.5;

double sine_above(const geometry::PropFace& face, const glm::dvec3& from) {
    return face.plane.distance(from) / glm::distance(from, face.middle());
}

/// h is constant on a face and d is convex, so the least light is at a corner.
double min_light(const geometry::PropFace& face, const glm::dvec3& projector) {
    double least = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : face.corners) {
        least = std::min(least, settings::received_light(face.plane, corner, projector));
    }
    return least;
}

} // namespace

LightCompensation light_compensation(const settings::Settings& settings) {
    LightCompensation compensation;
    compensation.reference = settings::even_light(settings);
    compensation.min_share = settings.prop.zone == settings::PropZone::Hand ? 1.0 : compensation.min_share;
    return compensation;
}

double reference_light(std::span<const SeenFace> faces, const glm::dvec3& projector,
                       const LightCompensation& compensation) {
    double share = 1.0;
    for (const SeenFace& each : faces) {
        const double reached = std::clamp(min_light(*each.face, projector) / compensation.reference,
                                          compensation.min_share, 1.0);
        const double seen = std::clamp(sine_above(*each.face, each.eye) / full_sine_of_sight, 0.0, 1.0);
        share = std::min(share, std::pow(reached, seen));
    }
    return compensation.reference * share;
}

FaceLight face_light(const geometry::PropFace& face, const glm::dmat4& projector_from_prop,
                     double reference) {
    // The plane in the projector's frame: m.Q = h with m = R n; with Q = Z r, 1 / Z = m.r / h.
    const glm::dmat3 rotation(projector_from_prop);
    const glm::dvec3 m = rotation * face.plane.normal;
    const double h = face.plane.offset + glm::dot(m, glm::dvec3(projector_from_prop[3]));
    FaceLight light;
    light.inverse_depth = glm::vec3(m / h);
    const glm::dvec3 projector = glm::transpose(rotation) * -glm::dvec3(projector_from_prop[3]);
    const double most = geometry::ease((sine_above(face, projector) - settings::min_sine_of_light) /
                                       (full_sine_of_light - settings::min_sine_of_light));
    light.most = static_cast<float>(most);
    // `h` is measured from the projector's origin along m: the projector is -h above the plane.
    light.per_cubic_metre = static_cast<float>(most * reference / -h);
    return light;
}

double gain(const FaceLight& light, const geometry::Pinhole& pinhole, const glm::dvec2& pixel) {
    const glm::dvec3 ray = pinhole.ray(pixel);
    const double d = glm::length(ray) / glm::dot(glm::dvec3(light.inverse_depth), ray);
    const double pixels = pinhole.lens.area_factor(ray.x * ray.x + ray.y * ray.y);
    return std::min(static_cast<double>(light.most),
                    static_cast<double>(light.per_cubic_metre) * d * d * d / pixels);
}

} // namespace frustumscreen::scene
