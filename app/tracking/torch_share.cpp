#include "app/tracking/torch_share.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::tracking {

namespace {

glm::dvec3 light_of(const geometry::RigidTransform& pose) {
    return pose.direction({0.0, 0.0, 1.0});
}

bool differ(const geometry::RigidTransform& a, const geometry::RigidTransform& b, double by_m,
            double by_rad) {
    const glm::dvec3 off = light_of(a) - light_of(b);
    return glm::distance(a.translation, b.translation) > by_m ||
           2.0 * std::asin(std::fmin(1.0, 0.5 * glm::length(off))) > by_rad;
}

} // namespace

void TorchShare::follow(MonotonicTime now, const geometry::RigidTransform& pose) {
    if (!rested_) {
        rested_ = pose;
        still_since_ = now;
    } else if (lies_ ? differ(pose, *rested_, taken_m, taken_rad)
                     : differ(pose, *rested_, still_m, still_rad)) {
        lies_ = false;
        rested_ = pose;
        still_since_ = now;
    }
    lies_ = lies_ || (now - still_since_ >= lies_after && -light_of(pose).z < across);
}

double TorchShare::update(MonotonicTime now,
                          const std::optional<geometry::RigidTransform>& table_from_torch) {
    if (table_from_torch) {
        follow(now, *table_from_torch);
    }
    lit_ = table_from_torch && !lies_ && table_from_torch->translation.z >= 0.0;
    const double dt_s = last_ ? to_seconds(std::max(now - *last_, Nanoseconds(0))) : 0.0;
    last_ = now;
    progress_ = std::clamp(progress_ + (lit_ ? dt_s / comes_s : -dt_s / goes_s), 0.0, 1.0);
    return geometry::ease(progress_);
}

} // namespace frustumscreen::tracking
