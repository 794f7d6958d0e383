/// The prop's pose as a tracker measured it that says how sure it is: tags in a camera's frame.
///
/// Frame    table T, metres.
/// Threads  values.
#pragma once

#include "app/geometry/transform.h"
#include "firmware_host/base/time.h"

namespace frustumscreen {

struct UncertainPose {
    MonotonicTime time;
    RigidTransform table_from_prop;
    double place_sd_m = 0.0;  ///< RMS distance from the true place
    double turn_sd_rad = 0.0; ///< RMS angle from the true turn
};

} // namespace frustumscreen
