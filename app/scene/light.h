/// The projector's light on the prop, and how the picture is dimmed to make it even.
///
/// A small surface at distance d whose normal makes the angle theta with the light gets cos(theta) / d^2. On
/// a plane with the projector h above it cos(theta) = h / d: the light is h / d^3, a steep face gets a
/// quarter of the top's. The picture is dimmed, in linear light, by reference / light, where the reference is
/// the light of the dimmest place that the visitor sees: every place then sends back the same, and no place
/// must be brighter than the projector can make it. Within a face only d changes, so the gain of a pixel is
/// scale * d^3, exact.
///
/// Two limits keep the picture bright. A face that gets less than `least_gain` of the brightest counts as if
/// it got that much: it stays a little dim and does not take all the others down. A face that the eye or the
/// projector sees only at a grazing angle counts only in part, so that no brightness jumps when the prop is
/// turned and a face comes in sight.
///
/// Frames   prop P, metres. Light in units of a surface square to the projector at 1 m.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"

#include <glm/glm.hpp>

#include <optional>
#include <span>

namespace frustumscreen {

struct LightCompensation {
    /// 0 = none, 1 = even light; between: a mixture of the two pictures, brighter and less even.
    double strength = 1.0;
    /// The dimmest place counts as getting at least this share of the brightest place's light.
    double least_gain = 0.1;
};

/// cos(theta) / d^2 at a point of a face; 0 or less where the projector is not above the face.
[[nodiscard]] double received_light(const Plane& face, const glm::dvec3& point, const glm::dvec3& projector);

/// A face of the prop, and the eye that its picture is for.
struct SeenFace {
    const PropFace* face = nullptr;
    glm::dvec3 eye{0.0};
};
/// The light that the faces are dimmed to. All of the prop's faces are given: one that the eye or the projector does
/// not see counts for nothing, and one that comes in sight counts by degrees, whether or not the artifact shows on it.
[[nodiscard]] double reference_light(std::span<const SeenFace> seen, const glm::dvec3& projector,
                                     const LightCompensation& compensation);

/// Gain of the pixel (u, v), in linear light, for a face: min(1, constant + per_cubic_metre * d^3), where the
/// lit point's distance is d = |((u - cx) / fx, (v - cy) / fy, 1)| / dot(inverse_depth, (u, v, 1)).
struct FaceLight {
    glm::vec3 inverse_depth{0.0F, 0.0F, 1.0F}; ///< 1/m, of the face's plane along the optical axis
    float constant = 1.0F;
    float per_cubic_metre = 0.0F;
};
/// `projector_from_prop` is rigid; the projector is above the face.
[[nodiscard]] FaceLight face_light(const Plane& face, const Pinhole& pinhole,
                                   const glm::dmat4& projector_from_prop, double reference,
                                   const LightCompensation& compensation);
[[nodiscard]] double gain(const FaceLight& light, const Pinhole& pinhole, const glm::dvec2& pixel);

} // namespace frustumscreen
