#include "app/exhibit/sensed.h"

namespace frustumscreen::exhibit {

guidance::Sensing Sensed::update(MonotonicTime now, const tracking::TrackedState& tracked_state, bool lost,
                                 const std::optional<MonotonicTime>& touched) {
    if (tracked_state.head_known) {
        head_seen_ = true;
        head_lost_.reset();
    } else if (head_seen_ && !head_lost_) {
        head_lost_ = now;
    }
    if (lost) {
        return tracked_state.tracker == tracker::TrackerHealth::Away ? guidance::Sensing::TrackerAway
                                                                     : guidance::Sensing::PropLost;
    }
    if (tracked_state.tracker == tracker::TrackerHealth::MetalNear) {
        return guidance::Sensing::MetalNear;
    }
    return head_lost_ && touched > head_lost_ ? guidance::Sensing::HeadLost : guidance::Sensing::Good;
}

} // namespace frustumscreen::exhibit
