/// The posture of the prop in a rest, from the tracker's report alone: flat on the table, flat on a block, or
/// leaning.
///
/// Frames   tracker K, as the device reports; the table's place in it may be unknown.
/// Method   Between flat rests the sensor turns about the table's normal. Two or more flat rests that are
///          turned differently determine the normal, its direction in the sensor, and the sensor's height.
/// Threads  pure; any.
#pragma once

#include "app/geometry/transform.h"

#include <optional>
#include <span>

namespace frustumscreen::calibration {

enum class Posture { Flat, Block, Leaning };

/// The posture of a prop that stands flat on the table.
struct FlatPosture {
    glm::dvec3 normal{0.0, 0.0, 1.0};    ///< the table's, in K; up or down
    glm::dvec3 in_sensor{0.0, 0.0, 1.0}; ///< the normal in the sensor
    double height_m = 0.0;               ///< the sensor's, along `normal`
    double tilt_rad = 0.0;               ///< of the least flat rest
};
/// The posture common to rests that are flat. Nothing if there is one rest only, or if no two differ by 10
/// degrees.
[[nodiscard]] std::optional<FlatPosture> flat_posture(std::span<const geometry::RigidTransform> rests);

struct RestStance {
    double tilt_rad = 0.0;
    double raised_m = 0.0; ///< above the flat height on the table, negative below; valid if it is not tilted
};
[[nodiscard]] RestStance stance_of(const FlatPosture& flat, const geometry::RigidTransform& rest);

} // namespace frustumscreen::calibration
