#include "app/exhibit/presence.h"

#include "app/geometry/rotation_angle.h"

namespace frustumscreen::exhibit {

namespace {

bool prop_has_moved(const tracking::TrackedState& now, const tracking::TrackedState& then) {
    const geometry::RigidTransform& a = now.table_from_prop;
    const geometry::RigidTransform& b = then.table_from_prop;
    return now.prop_known &&
           (!then.prop_known || glm::distance(a.translation, b.translation) > Presence::moved_m ||
            geometry::rotation_angle(a.rotation, b.rotation) > Presence::turned_rad);
}

bool head_has_moved(const tracking::TrackedState& now, const tracking::TrackedState& then) {
    constexpr double nodded_m = 0.05; // a head is never quite still
    return now.eye_known() && (!then.eye_known() || glm::distance(now.eye_m, then.eye_m) > nodded_m);
}

/// A torch that lies still or is fixed does not show that a visitor is present.
bool torch_has_moved(const tracking::TrackedState& now, const tracking::TrackedState& then) {
    constexpr double waved_m = 0.03, waved_rad = 0.1;
    for (std::size_t k = 0; k < now.torches.size(); ++k) {
        const tracking::TrackedTorch& a = now.torches.at(k);
        const tracking::TrackedTorch& b = then.torches.at(k);
        if (a.share > 0.0 &&
            (b.share <= 0.0 ||
             glm::distance(a.table_from_torch.translation, b.table_from_torch.translation) > waved_m ||
             geometry::rotation_angle(a.table_from_torch.rotation, b.table_from_torch.rotation) >
                 waved_rad)) {
            return true;
        }
    }
    return false;
}

} // namespace

bool Presence::update(MonotonicTime now, const tracking::TrackedState& tracked_state, bool active) {
    const bool prop = rested_ && prop_has_moved(tracked_state, *rested_);
    const bool moved =
        prop ||
        (rested_ && (head_has_moved(tracked_state, *rested_) || torch_has_moved(tracked_state, *rested_)));
    rested_ = moved || !rested_ ? tracked_state : rested_;
    moved_ = moved || active ? now : moved_;
    prop_moved_ = prop ? now : prop_moved_;
    touched_ = prop || active ? now : touched_;
    there_ = moved_ && now - *moved_ < stays;
    return there_;
}

} // namespace frustumscreen::exhibit
