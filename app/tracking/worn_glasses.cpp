#include "app/tracking/worn_glasses.h"

#include "app/tracking/pose_math.h"

namespace frustumscreen::tracking {

bool WornGlasses::worn(MonotonicTime time, const geometry::RigidTransform& table_from_sensor) {
    if (!rested_ || slip_m(step_between(rested_->table_from_sensor, table_from_sensor), lever_m) > still_m) {
        rested_ = Rest{table_from_sensor, time};
    }
    return time - rested_->since < still_for;
}

} // namespace frustumscreen::tracking
