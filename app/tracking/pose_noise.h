/// Scatter of a tracker's poses at rest.
///
/// Threads  a value.
#pragma once

namespace frustumscreen::tracking {

/// On each axis, RMS.
struct PoseNoise {
    double place_m = 0.0003;
    double turn_rad = 0.0026; ///< 0.15 degrees
};

} // namespace frustumscreen::tracking
