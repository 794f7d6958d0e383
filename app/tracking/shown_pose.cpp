#include "app/tracking/shown_pose.h"

#include "app/geometry/time_curves.h"

#include <cmath>

namespace frustumscreen::tracking {

namespace {

/// Largest slope of `ease`.
constexpr double steepest = 1.5;

} // namespace

const geometry::RigidTransform& ShownPose::follow(const PoseEstimate& estimate, MonotonicTime time) {
    if (reinitialisations_ == 0) {
        shown_ = estimate.pose; // there is no shown pose yet to glide from
    }
    if (estimate.status == PoseStatus::Stale) {
        return shown_;
    }
    if (estimate.reinitialisations != reinitialisations_) {
        left_ = step_between(estimate.pose, shown_);
        return_ = time;
        const double calm_s = options_.fastest_m_s > 0.0
                                  ? steepest * slip_m(left_, options_.lever_m) / options_.fastest_m_s
                                  : 0.0;
        returns_s_ = std::fmax(to_seconds(options_.return_time), calm_s);
        reinitialisations_ = estimate.reinitialisations;
    }
    const double gone = geometry::ease(to_seconds(time - return_) / returns_s_);
    const geometry::RigidTransform goal =
        moved(estimate.pose, {(1.0 - gone) * left_.shift_m, (1.0 - gone) * left_.turn_rad});
    const double off_m = slip_m(step_between(shown_, goal), options_.lever_m);
    if (off_m > options_.slack_m) {
        shown_ = goal;
    }
    return shown_;
}

} // namespace frustumscreen::tracking
