/// The prop's pose with its uncertainty, as measured by tags in a camera's frame.
///
/// Frame    table T, metres.
/// Threads  values.
#pragma once

#include "app/geometry/transform.h"
#include "firmware_host/base/time.h"

namespace frustumscreen::tracking {

struct UncertainPose {
    MonotonicTime time;
    geometry::RigidTransform table_from_prop;
    double place_sd_m = 0.0;  ///< RMS distance from the true position
    double turn_sd_rad = 0.0; ///< RMS angle from the true rotation
};

} // namespace frustumscreen::tracking
