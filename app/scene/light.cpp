#include "app/scene/light.h"

#include "app/geometry/time_curves.h"
#include "app/guidance/seen_places.h"
#include "app/settings/light_range.h"
#include "app/settings/lit_zone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace frustumscreen::scene {

namespace {

/// Sine of the eye's elevation above a face at which the face counts fully.
constexpr double full_sine_of_sight = 0.5;
/// Share of the seen artifact at which a face through which it is seen counts fully.
constexpr double full_share_of_artifact = 0.25;

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

/// The light that decides how far the artifact dims with a face, and the face's weight, 0..1.
struct Dimming {
    double light = 0.0;
    double weight = 0.0;
};

Dimming by_face(const SeenFace& seen, const glm::dvec3& projector) {
    return {min_light(*seen.face, projector), sine_above(*seen.face, seen.eye) / full_sine_of_sight};
}

/// h is constant on a face: the least light is at the place that is farthest from the projector.
Dimming by_artifact(const SeenFace& seen, const glm::dvec3& projector, const guidance::SeenOutline& outline) {
    const geometry::Plane& plane = seen.face->plane;
    if (!(plane.distance(seen.eye) > 0.0)) {
        return {};
    }
    const guidance::SeenOutline::Through through = outline.through(*seen.face, projector);
    if (!(through.farthest_m > 0.0)) {
        return {};
    }
    return {plane.distance(projector) / std::pow(through.farthest_m, 3.0),
            through.share / full_share_of_artifact};
}

/// The outline of the hull for an eye that looks at the middle of all its corners.
guidance::SeenOutline outline_of(const glm::dvec3& eye, std::span<const glm::dvec3> hull) {
    glm::dvec3 way(0.0);
    for (const glm::dvec3& corner : hull) {
        way += corner - eye;
    }
    return {eye, way / std::fmax(glm::length(way), std::numeric_limits<double>::min()), hull};
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
    std::optional<guidance::SeenOutline> outline;
    glm::dvec3 eye(0.0); // of the outline
    for (const SeenFace& each : faces) {
        if (min_light(*each.face, projector) >= compensation.reference) {
            continue;
        }
        if (compensation.hull && !(outline && eye == each.eye)) {
            eye = each.eye;
            outline.emplace(outline_of(eye, *compensation.hull));
        }
        const Dimming dimming = outline ? by_artifact(each, projector, *outline) : by_face(each, projector);
        const double reached =
            std::clamp(dimming.light / compensation.reference, compensation.min_share, 1.0);
        share = std::min(share, std::pow(reached, std::clamp(dimming.weight, 0.0, 1.0)));
    }
    return compensation.reference * share;
}

glm::vec3 inverse_depth_of(const geometry::PropFace& face, const glm::dmat4& projector_from_prop) {
    // The plane in the projector's frame: m.Q = h with m = R n; with Q = Z r, 1 / Z = m.r / h.
    const glm::dvec3 m = glm::dmat3(projector_from_prop) * face.plane.normal;
    return glm::vec3(m / (face.plane.offset + glm::dot(m, glm::dvec3(projector_from_prop[3]))));
}

FaceLight face_light(const geometry::PropFace& face, const glm::dmat4& projector_from_prop,
                     double reference) {
    const glm::dmat3 rotation(projector_from_prop);
    const glm::dvec3 m = rotation * face.plane.normal;
    const double h = face.plane.offset + glm::dot(m, glm::dvec3(projector_from_prop[3]));
    FaceLight light;
    light.inverse_depth = inverse_depth_of(face, projector_from_prop);
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
