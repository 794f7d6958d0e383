/// The light that the prop's faces get from the projector, over all places where visitors slide the prop.
///
/// The prop stands upright with its whole bottom on the table, turned to any yaw. Visitors may stand on every
/// side of the table, so every face is seen by some eye.
///
/// Frames   table T, metres; the prop's own for one face. Light in units of a surface square to the projector
///          at 1 m.
/// Threads  pure; any.
/// Method   samples: the middle, the corners and the edges' middles of the rectangle of places, every third degree
///          of yaw, the faces' corners and middles. On a face the light is h / d^3 with h linear in the place, so
///          its minimum is at a corner; between two yaws it differs by less than 1e-3 of itself.
#pragma once

#include "app/settings/settings.h"

#include <glm/glm.hpp>

namespace frustumscreen::settings {

/// cos(theta) / d^2 at a point of a face; 0 or less if the projector is not above the face.
[[nodiscard]] double received_light(const geometry::Plane& face, const glm::dvec3& point,
                                    const glm::dvec3& projector);

/// The farthest place of the prop's axis from the table's centre, along X and Y, with the whole bottom on the
/// table at every yaw; 0 if the table is too small.
[[nodiscard]] glm::dvec2 reach_on_table(const PropSettings& prop, const TableSettings& table);

struct LightRange {
    double least = 0.0; ///< at the dimmest corner of a face
    double most = 0.0;  ///< at the brightest corner or middle of a face
    /// The darkest face's light at its middle, divided by the brightest face's, at one place and yaw; the minimum
    /// over all places and yaws. 0 or less: a face looks away from the projector.
    double evenness = 1.0;
};
/// `lens`: table frame.
[[nodiscard]] LightRange light_range(const geometry::PropShape& prop, const glm::dvec3& lens,
                                     const glm::dvec2& reach_m);

/// Light that the prop sends back at every place, so that the artifact looks the same wherever the prop stands: the
/// light at the dimmest place of the prop, but at least a quarter of that at the brightest place, because a dark
/// picture everywhere is worse than a dim face far out. In the hand: a quarter of the light on the prop's top at
/// the table's centre.
[[nodiscard]] double even_light(const Settings& settings);

} // namespace frustumscreen::settings
