/// One sighting: with one eye shut, a person aligns a place of the prop's top with the middle of a cross on
/// the table. The open eye lies on the line from the cross through that place. The tracker reports the head's
/// sensor meanwhile.
///
/// Frames   table T; sensor S of the head.
/// Units    metres.
/// Threads  values; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"

#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::calibration {

enum class OpenEye { Left, Right };

struct EyeSight {
    OpenEye eye = OpenEye::Left;
    geometry::RigidTransform table_from_sensor; ///< of the head
    glm::dvec3 cross_m{0.0};                    ///< the cross's middle, on the table
    glm::dvec3 tip_m{0.0};                      ///< the prop's place that covers it
};
using EyeSights = std::vector<EyeSight>;

/// A sighting as reported: the head's sensor in the tracker's frame, and the pixel that lights the cross.
struct ReportedSight {
    OpenEye eye = OpenEye::Left;
    geometry::RigidTransform tracker_from_sensor;
    glm::dvec2 pixel{0.0};
    glm::dvec3 tip_m{0.0}; ///< table
};
using ReportedSights = std::vector<ReportedSight>;

/// Sightings on a table whose projector and tracker are known. Nothing if the light of a cross does not reach
/// the table.
[[nodiscard]] std::optional<EyeSights> placed_sights(std::span<const ReportedSight> reported,
                                                     const geometry::Pinhole& pinhole,
                                                     const geometry::RigidTransform& table_from_projector,
                                                     const geometry::RigidTransform& table_from_tracker);

/// Standard deviations. Shared errors do not shrink with the number of sightings.
struct SightNoise {
    double aim_m = 1.5e-3;  ///< of each, across its line at the tip: hand, pupil, the cross's width
    double head_m = 1.5e-3; ///< of each coordinate of each: the head's tremor, the tracker
    double head_rad = 3e-3; ///< of each, about each axis
    double cross_m = 7e-4;  ///< shared, along the table: the picture of a good calibration
    double tip_m = 7e-4;    ///< shared, of each coordinate: the prop at rest
};

} // namespace frustumscreen::calibration
