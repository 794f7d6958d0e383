#include "app/exhibit/sensed.h"

namespace frustumscreen {

Sensing Sensed::update(MonotonicTime now, const TrackedState& tracked_state, bool lost,
                       const std::optional<MonotonicTime>& touched) {
    if (tracked_state.head_known) {
        head_seen_ = true;
        head_lost_.reset();
    } else if (head_seen_ && !head_lost_) {
        head_lost_ = now;
    }
    if (lost) {
        return tracked_state.tracker == TrackerHealth::Away ? Sensing::TrackerAway : Sensing::PropLost;
    }
    if (tracked_state.tracker == TrackerHealth::MetalNear) {
        return Sensing::MetalNear;
    }
    return head_lost_ && touched > head_lost_ ? Sensing::HeadLost : Sensing::Good;
}

} // namespace frustumscreen
