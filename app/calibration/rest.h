/// One rest of the prop: it stands still, and a camera helps to find the projector pixel that lights each of
/// some known points of it.
///
/// Frames   K is the tracker's own frame; the prop's has its origin at the middle of its bottom, +Z up through its top.
/// Units    metres; pixels, the centre of the top left one is (0.5, 0.5).
/// Threads  values; any.
#pragma once

#include "app/geometry/transform.h"

#include <optional>
#include <vector>

namespace frustumscreen::calibration {

struct PropPoint {
    glm::dvec3 prop_m{0.0};
    glm::dvec2 pixel{0.0}; ///< the projector pixel that lights it
};

struct Rest {
    int name = 0;                                 ///< number shown to people
    geometry::RigidTransform tracker_from_sensor; ///< what the tracker reported, once for all points
    std::vector<PropPoint> points;
    std::optional<double> block_m; ///< height of the prop's flat bottom above the table; none: it leans
};

using Rests = std::vector<Rest>;

/// Standard deviations of each coordinate. A rest's points share one tracker error.
struct RestNoise {
    double position_m = 3e-4;
    double rotation_rad = 2.6e-3; ///< about each axis; 0.15 degrees
    double pixel = 0.2;           ///< of a point's pixel: decoding, the tag's corner, print
    double block_m = 1e-4;        ///< of each of three heights of the prop's bottom
};

} // namespace frustumscreen::calibration
