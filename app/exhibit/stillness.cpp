#include "app/exhibit/stillness.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::exhibit {

namespace {

bool has_moved(const tracking::TrackedState& now, const tracking::TrackedState& then) {
    const geometry::RigidTransform& a = now.table_from_prop;
    const geometry::RigidTransform& b = then.table_from_prop;
    const double cosine = std::min(1.0, std::abs(glm::dot(a.rotation, b.rotation)));
    return now.prop_known != then.prop_known ||
           glm::distance(a.translation, b.translation) > Stillness::moved_m ||
           2.0 * std::acos(cosine) > Stillness::turned_rad ||
           glm::distance(now.eye_m, then.eye_m) > Stillness::stepped_m;
}

} // namespace

Nanoseconds Stillness::update(MonotonicTime now, const tracking::TrackedState& tracked_state, bool pressed) {
    if (!rested_ || pressed || has_moved(tracked_state, *rested_)) {
        rested_ = tracked_state;
        moved_ = now;
    }
    return now - moved_;
}

} // namespace frustumscreen::exhibit
