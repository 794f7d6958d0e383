/// How much of the projector's light the prop's faces get, over all places where visitors slide the prop.
///
/// The prop stands upright with its whole bottom on the table, turned to any yaw. Visitors may stand on every
/// side of the table, so every face is seen by some eye.
///
/// Frames   table T, metres; the prop's own for one face. Light in units of a surface square to the projector
///          at 1 m.
/// Threads  pure; any.
/// Method   samples: the middle, the corners and the edges' middles of the rectangle of places, each third
///          degree of yaw, the faces' corners and middles. On a face the light is h / d^3 with h linear in the place, so
///          its least is at a corner; between two yaws it differs by less than 1e-3 of itself.
#pragma once

#include "app/settings/settings.h"

#include <glm/glm.hpp>

namespace frustumscreen {

/// cos(theta) / d^2 at a point of a face; 0 or less where the projector is not above the face.
[[nodiscard]] double received_light(const Plane& face, const glm::dvec3& point, const glm::dvec3& projector);

/// How far from the table's centre the prop's axis can be, along X and Y, with the whole bottom on the table
/// at every yaw; 0 where the table is too small.
[[nodiscard]] glm::dvec2 reach_on_table(const PropSettings& prop, const TableSettings& table);

struct LightRange {
    double least = 0.0; ///< at the dimmest corner of a face
    double most = 0.0;  ///< at the brightest corner or middle of a face
    /// Of the faces at one place and yaw: the darkest one's light at its middle, divided by the brightest
    /// one's; the least of all places and yaws. 0 or less: a face looks away from the projector.
    double evenness = 1.0;
};
/// `lens`: table frame.
[[nodiscard]] LightRange light_range(const PropShape& prop, const glm::dvec3& lens,
                                     const glm::dvec2& reach_m);

/// What every place of the prop sends back, so that the artifact looks the same wherever the prop stands: the
/// light of the dimmest place that the prop can come to, but at least a quarter of the brightest place's,
/// because a dark picture everywhere costs more than a dim face far out. In the hand: a quarter of what the
/// prop's top gets at the table's centre.
[[nodiscard]] double even_light(const Settings& settings);

} // namespace frustumscreen
