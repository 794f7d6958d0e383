/// One touch: the prop is laid on a cross that the projector shows, and rests there.
///
/// Frames   K is the tracker's own frame; the sensor's frame is the one that the tracker reports.
/// Units    metres; pixels, the centre of the top left one is (0.5, 0.5).
/// Threads  values; any.
#pragma once

#include "app/geometry/transform.h"

#include <vector>

namespace frustumscreen::calibration {

struct Touch {
    geometry::RigidTransform tracker_from_sensor; ///< what the tracker reported
    glm::dvec2 pixel{0.0};                        ///< that lights the cross
    double block_m = 0.0;                         ///< height of the touched place above the table
};

using Touches = std::vector<Touch>;

/// Standard deviations of each coordinate of a touch, averaged over one second of rest.
struct TouchNoise {
    double position_m = 3e-4;
    double rotation_rad = 2.6e-3; ///< about each axis; 0.15 degrees
    double pixel = 0.5;           ///< placement of the prop on the cross
    double block_m = 1e-4;
};

} // namespace frustumscreen::calibration
