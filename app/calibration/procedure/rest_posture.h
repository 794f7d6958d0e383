/// How the prop stands in a rest, by the tracker's report alone: flat on the table, flat on a block, or leaning.
///
/// Frames   tracker K, as the device reports; it need not be known where the table lies in it.
/// Method   Between rests that stand flat the sensor turns about the table's normal. From two of them or more that are turned differently follow that
///          normal, how it lies in the sensor, and how high the sensor then is.
/// Threads  pure; any.
#pragma once

#include "app/geometry/transform.h"

#include <optional>
#include <span>

namespace frustumscreen {

enum class Posture { Flat, Block, Leaning };

/// Of a prop that stands flat on the table.
struct FlatPosture {
    glm::dvec3 normal{0.0, 0.0, 1.0};    ///< the table's, in K; up or down
    glm::dvec3 in_sensor{0.0, 0.0, 1.0}; ///< the same, in the sensor
    double height_m = 0.0;               ///< the sensor's, along `normal`
    double tilt_rad = 0.0;               ///< of the one of them that stands least flat
};
/// Of rests that are said to stand flat. Nothing: one alone, or none is turned by 10 degrees.
[[nodiscard]] std::optional<FlatPosture> flat_posture(std::span<const RigidTransform> rests);

struct RestStance {
    double tilt_rad = 0.0;
    double raised_m = 0.0; ///< above where it stands flat on the table, or below; true where it is not tilted
};
[[nodiscard]] RestStance stance_of(const FlatPosture& flat, const RigidTransform& rest);

} // namespace frustumscreen
