/// The pose that the picture is drawn for, after the estimate: at rest it rests, and where the estimate
/// jumps, since the prop was lost and found elsewhere, it glides there.
///
/// Rest     while the estimate is within `slack_m` of the shown pose, at the prop, that
///          stays bit for bit, and a picture at rest is not drawn again. Never farther off than the slack.
/// Return   the difference to the old pose is taken away along a smooth step.
/// Time     of the pictures; time that goes back moves nothing.
/// Threads  one caller. Allocates nothing.
#pragma once

#include "app/tracking/pose_estimator.h"
#include "app/tracking/pose_math.h"

namespace frustumscreen {

struct ShownPoseOptions {
    double slack_m = 0.00005;
    double lever_m = 0.06; ///< half the prop's height
    Nanoseconds return_time = std::chrono::milliseconds(250);
};

class ShownPose {
public:
    explicit ShownPose(const ShownPoseOptions& options = {}) : options_(options) {}

    /// The pose to draw at `time`. A stale estimate changes nothing.
    [[nodiscard]] const RigidTransform& follow(const PoseEstimate& estimate, MonotonicTime time);

private:
    ShownPoseOptions options_;
    RigidTransform shown_;
    PoseStep left_;        ///< from the estimate to the old pose when the return began
    MonotonicTime return_; ///< when it began
    std::uint64_t reinitialisations_ = 0;
};

} // namespace frustumscreen
