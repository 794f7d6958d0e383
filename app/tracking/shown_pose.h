/// The pose that the picture is drawn for. It follows the estimate but stands still at rest; if the estimate
/// jumps, because the prop was lost and found elsewhere, it glides there.
///
/// Rest     while the estimate is within `slack_m` of the shown pose, measured at the prop, the shown pose is
///          constant bit for bit, and the picture is not drawn again. The shown pose is never farther off.
/// Return   the difference to the old pose fades along a smooth step; from afar it takes longer, so that it is never faster
///          than `fastest_m_s`.
/// Frames   those of the estimate; metres.
/// Time     of the pictures; a decreasing time moves nothing.
/// Threads  one caller. Allocates nothing.
#pragma once

#include "app/tracking/pose_estimator.h"
#include "app/tracking/pose_math.h"

namespace frustumscreen::tracking {

struct ShownPoseOptions {
    double slack_m = 0.00005;
    double lever_m = 0.06; ///< half the prop's height
    Nanoseconds return_time = std::chrono::milliseconds(250);
    double fastest_m_s = 0.0; ///< of the return alone, at the prop; 0: any
};

class ShownPose {
public:
    explicit ShownPose(const ShownPoseOptions& options = {}) : options_(options) {}

    /// The pose to draw at `time`. A stale estimate has no effect.
    [[nodiscard]] const geometry::RigidTransform& follow(const PoseEstimate& estimate, MonotonicTime time);

private:
    ShownPoseOptions options_;
    geometry::RigidTransform shown_;
    PoseStep left_;          ///< from the estimate to the old pose at the start of the return
    MonotonicTime return_;   ///< start of the return
    double returns_s_ = 1.0; ///< its length
    std::uint64_t reinitialisations_ = 0;
};

} // namespace frustumscreen::tracking
