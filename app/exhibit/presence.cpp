#include "app/exhibit/presence.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

bool has_moved(const Situation& now, const Situation& then) {
    const RigidTransform& a = now.table_from_prop;
    const RigidTransform& b = then.table_from_prop;
    const double cosine = std::min(1.0, std::abs(glm::dot(a.rotation, b.rotation)));
    const bool prop = now.prop_known &&
                      (!then.prop_known || glm::distance(a.translation, b.translation) > Presence::moved_m ||
                       2.0 * std::acos(cosine) > Presence::turned_rad);
    constexpr double nodded_m = 0.05; // nobody holds their head still
    const bool head = now.head_known && (!then.head_known || glm::distance(now.eye_m, then.eye_m) > nodded_m);
    return prop || head;
}

} // namespace

bool Presence::update(MonotonicTime now, const Situation& situation, bool pressed) {
    if (!rested_) {
        rested_ = situation;
    } else if (has_moved(situation, *rested_)) {
        rested_ = situation;
        moved_ = now;
    }
    if (pressed) {
        moved_ = now;
    }
    return moved_ && now - *moved_ < stays;
}

} // namespace frustumscreen
