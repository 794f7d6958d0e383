/// The zone of the table in which every face of the prop that the visitor sees is lit.
///
/// A face is lit if the projector's lens lies above the face's plane, by at least `min_sine_of_light` times its
/// distance from the prop (below that the light only grazes the face), and all four corners lie in the picture. The
/// prop is convex, so no face shades another.
///
/// On the table (PropZone) the prop stands upright with its whole bottom on the table top. In the hand it may
/// be turned, at any place, so that a face the visitor sees looks away from the lens. Its zone is therefore the
/// places at which the whole prop lies in the picture, however it is turned.
///
/// Frames   table T, metres; polygons are counter-clockwise, empty if there is no place.
/// Threads  pure; any.
/// Method   a side face's azimuth enters every condition through one cosine, so 'at any yaw' is the least
///          cosine over the arc of azimuths that the eye sees: exact, nothing is sampled.
#pragma once

#include "app/geometry/transform.h"
#include "app/settings/polygon.h"
#include "app/settings/settings.h"

#include <glm/glm.hpp>

namespace frustumscreen::settings {

/// About 2 degrees: a face lit at less gets under a tenth of the usual light of the steep faces.
inline constexpr double min_sine_of_light = 0.035;

struct LitZone {
    /// Places of the prop's axis at which every face is lit at every yaw, for eyes anywhere above the table. In the
    /// hand: places of the prop's middle, as high above the table as the prop reaches from its middle. Convex.
    Polygon any_eye;
    /// The largest rectangle along the axes in `any_eye` about its centroid: where a simulated visitor may slide
    /// the prop.
    Rectangle any_eye_rectangle;
    /// Places at which every face that the default eye sees is lit at every yaw. The outline has a point at least
    /// at every degree around the zone's middle. In the hand: the same as for any eye.
    Polygon default_eye;
};

[[nodiscard]] LitZone lit_zone(const Settings& settings);
/// `any_eye_rectangle` alone, in a small part of the time.
[[nodiscard]] Rectangle lit_rectangle(const Settings& settings);

/// Tests one pose, upright or not.
[[nodiscard]] bool every_seen_face_is_lit(const Settings& settings,
                                          const geometry::RigidTransform& table_from_prop,
                                          const glm::dvec3& eye);

/// The part of the table, lifted to height `z`, whose points lie in the picture together with a circle of radius
/// `circle_m` around them. Convex.
[[nodiscard]] Polygon picture_on_table(const Settings& settings, double z, double circle_m = 0.0);

} // namespace frustumscreen::settings
