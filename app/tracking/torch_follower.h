/// Follows one torch: its pose at the time at which the picture is lit, steady, and the share of its light.
///
/// Frames   table T.
/// Time     a sample takes effect at its own time; `at(lit)` must not go back.
/// Threads  values; one caller. Allocates nothing after construction.
#pragma once

#include "app/tracking/pose_estimator.h"
#include "app/tracking/shown_pose.h"
#include "app/tracking/steady_filter.h"
#include "app/tracking/torch_share.h"
#include "app/tracking/tracked_state.h"

namespace frustumscreen::tracking {

/// The sources of torches: the tracker's station 3, and a camera that sees a tag on a lamp.
struct TorchSources {
    bool tracker = false, camera = false;
};

class TorchFollower {
public:
    /// `lost_after`: a torch whose latest pose is older is lost.
    TorchFollower(const SteadyFilterOptions& options, Nanoseconds lost_after);

    Taken take(MonotonicTime time, const geometry::RigidTransform& table_from_torch) {
        return estimator_.take(time, table_from_torch);
    }
    [[nodiscard]] TrackedTorch at(MonotonicTime lit);

private:
    PoseEstimator estimator_;
    ShownPose shown_;
    TorchShare share_;
    Nanoseconds lost_after_;
};

} // namespace frustumscreen::tracking
