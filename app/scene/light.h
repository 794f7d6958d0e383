/// The projector's light on the prop, and how the picture is dimmed to make it even.
///
/// A small surface at distance d whose normal makes the angle theta with the light receives cos(theta) / d^2.
/// On a plane with the projector h above it cos(theta) = h / d, so the light is h / d^3, and a steep face
/// receives a fraction of the top's light. The picture is dimmed, in linear light, by reference / light. The
/// reference is one number of the set-up (even_light in light_range.h), so that the artifact has equal
/// brightness at every place of every face, in every pose and for every eye, and never jumps. Within a face
/// only d changes, so the gain of a pixel is scale * d^3, exactly.
///
/// Where a place through which the eye sees the artifact gets less than the reference, no gain can help: the
/// projector is at its maximum. Then the whole artifact dims with the face's darkest such place, weighted by how
/// much of the artifact is seen through the face, but not below `min_share`; a face that gets even less dims alone.
/// Without a known artifact the face's darkest corner counts, weighted by how much of the face the eye sees. A face
/// lit at a grazing angle fades out, because there a pixel becomes a long stripe.
///
/// Frames   prop P, metres. Light in units of the light on a surface square to the projector at 1 m.
/// Threads  pure; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/prop_shape.h"
#include "app/settings/settings.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::scene {

struct LightCompensation {
    /// The light that every place is dimmed to.
    double reference = 0.25;
    /// Lower limit for dimming the artifact as a whole, 0..1; 1: it never dims.
    double min_share = 0.3;
    /// The corners of the hull of the artifact that is shown, prop frame; null: unknown.
    std::shared_ptr<const std::vector<glm::dvec3>> hull{};
};

/// As many corners of a hull as a frame has time for; 64 hold a ball with 3 % to spare.
inline constexpr std::size_t max_corners_in_frame = 64;

/// The exhibit's compensation in this set-up. In the hand an artifact never dims as a whole, because a
/// visitor need not correct a face that is turned away from the projector.
[[nodiscard]] LightCompensation light_compensation(const settings::Settings& settings);

/// Sine of the light's elevation above a face's middle: from here on a face counts as fully lit; down to
/// min_sine_of_light (lit_zone.h) it fades out. At 0.12, a pixel of 0.42 mm makes a stripe of 3.5 mm.
inline constexpr double full_sine_of_light = 0.3;

/// A face of the prop, and the eye that its picture is for.
struct SeenFace {
    const geometry::PropFace* face = nullptr;
    glm::dvec3 eye{0.0};
};
/// The light that the faces are dimmed to. `faces` are all of the prop's faces: one that the eye does not see
/// has no effect, and neither has one that shows nothing of a known artifact; one through which some of it comes
/// into view takes effect gradually.
[[nodiscard]] double reference_light(std::span<const SeenFace> faces, const glm::dvec3& projector,
                                     const LightCompensation& compensation);

/// Gain of the pixel (u, v), in linear light, for a face: min(most, per_cubic_metre * d^3), where the lit
/// point's distance is d = |ray| / dot(inverse_depth, ray), and ray = ((u - cx) / fx, (v - cy) / fy, 1).
/// Behind a lens that distorts, the ray is the one through the pixel, and the gain is less where the lens
/// packs pixels more densely.
struct FaceLight {
    glm::vec3 inverse_depth{0.0F, 0.0F, 1.0F}; ///< 1/m, of the face's plane along the optical axis
    float per_cubic_metre = 0.0F;
    float most = 1.0F; ///< less where the light grazes the face
};
/// FaceLight::inverse_depth.
[[nodiscard]] glm::vec3 inverse_depth_of(const geometry::PropFace& face,
                                         const glm::dmat4& projector_from_prop);
/// `projector_from_prop` is rigid; the projector is above the face.
[[nodiscard]] FaceLight face_light(const geometry::PropFace& face, const glm::dmat4& projector_from_prop,
                                   double reference);
[[nodiscard]] double gain(const FaceLight& light, const geometry::Pinhole& pinhole, const glm::dvec2& pixel);

} // namespace frustumscreen::scene
