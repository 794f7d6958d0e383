/// One way to smooth and predict poses; frustumscreen-bench latency compares them.
///
/// Frames   those of the poses given; metres, radians, unit quaternions of either sign.
/// Time     seconds since the pose before; the caller gives only steps above 0.
/// Threads  one caller. Allocates nothing after construction.
/// Errors   none: the caller gives only finite poses (PoseEstimator sees to it).
#pragma once

#include "app/geometry/transform.h"

namespace frustumscreen {

/// How far a pose may be off, on each axis, standard deviation.
struct PoseSpread {
    double place_m = 0.0;
    double turn_rad = 0.0;
};

class PoseFilter {
public:
    virtual ~PoseFilter() = default;
    /// Begins anew: nothing is known but this pose.
    virtual void restart(const RigidTransform& measured) = 0;
    /// The next pose, `dt_s` after the one before.
    virtual void take(const RigidTransform& measured, double dt_s) = 0;
    /// The pose `ahead_s` after the latest one taken; 0 = smoothed only.
    [[nodiscard]] virtual RigidTransform ahead(double ahead_s) const = 0;
    /// Of that pose, by the filter's own models; one that has none says zero.
    [[nodiscard]] virtual PoseSpread spread(double /*ahead_s*/) const { return {}; }
};

} // namespace frustumscreen
