/// One touch: the prop was laid on a cross that the projector showed, and rested there.
///
/// Frames   K is the tracker's own frame; the sensor's frame is that which the tracker reports.
/// Units    metres; pixels, the centre of the top left one is (0.5, 0.5).
/// Threads  values; any.
#pragma once

#include "app/geometry/transform.h"

#include <vector>

namespace frustumscreen {

struct Touch {
    RigidTransform tracker_from_sensor; ///< what the tracker reported
    glm::dvec2 pixel{0.0};              ///< that lit the cross
    double block_m = 0.0;               ///< height of the touched place above the table
};

using Touches = std::vector<Touch>;

/// Standard deviations of a touch, of each coordinate: after a second's rest of the prop.
struct TouchNoise {
    double position_m = 3e-4;
    double rotation_rad = 2.6e-3; ///< about each axis; 0.15 degrees
    double pixel = 0.5;           ///< how well the prop is laid on the cross
    double block_m = 1e-4;
};

} // namespace frustumscreen
