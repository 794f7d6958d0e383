#include "app/tracking/worn_glasses.h"

#include "app/geometry/time_curves.h"
#include "app/tracking/pose_math.h"

#include <algorithm>

namespace frustumscreen::tracking {

bool WornGlasses::worn(MonotonicTime time, const geometry::RigidTransform& table_from_sensor) {
    if (!calm_) {
        calm_ = Calm{table_from_sensor, time};
        rested_ = *calm_;
    }
    const double share = geometry::follow_share(to_seconds(time - calm_->time), to_seconds(calm_within));
    calm_ = Calm{between(calm_->table_from_sensor, table_from_sensor, share), std::max(calm_->time, time)};
    if (slip_m(step_between(rested_.table_from_sensor, calm_->table_from_sensor), lever_m) > still_m) {
        rested_ = *calm_;
    }
    return calm_->time - rested_.time < still_for;
}

} // namespace frustumscreen::tracking
