/// A method to smooth and predict poses; frustumscreen-bench latency compares such methods.
///
/// Frames   those of the given poses; metres, radians, unit quaternions of either sign.
/// Time     seconds since the previous pose; the caller gives only steps above 0.
/// Threads  one caller. Allocates nothing after construction.
/// Errors   none: the caller gives only finite poses (PoseEstimator checks that).
#pragma once

#include "app/geometry/transform.h"

namespace frustumscreen::tracking {

/// Error of a pose on each axis, standard deviation.
struct PoseSpread {
    double place_m = 0.0;
    double turn_rad = 0.0;
};

class PoseFilter {
public:
    virtual ~PoseFilter() = default;
    /// Restarts: only this pose is known.
    virtual void restart(const geometry::RigidTransform& measured) = 0;
    /// The next pose, `dt_s` after the previous one.
    virtual void take(const geometry::RigidTransform& measured, double dt_s) = 0;
    /// The pose `ahead_s` after the latest one taken; 0 = smoothed only.
    [[nodiscard]] virtual geometry::RigidTransform ahead(double ahead_s) const = 0;
    /// Error of `ahead(ahead_s)` by the filter's own model; zero without a model.
    [[nodiscard]] virtual PoseSpread spread(double /*ahead_s*/) const { return {}; }
};

} // namespace frustumscreen::tracking
