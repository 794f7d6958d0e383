#include "app/tracking/tracked_state.h"

#include "app/tracking/level_head.h"

#include <cmath>

namespace frustumscreen::tracking {

std::array<glm::dvec3, 2> eyes_of(const TrackedState& state, double interocular_m) {
    const glm::dvec3 half_m =
        state.table_from_head * glm::dvec3(0.5 * interocular_m * state.eyes_apart, 0.0, 0.0);
    return {state.eye_m - half_m, state.eye_m + half_m};
}

TrackedStateTracker::TrackedStateTracker(const glm::dvec3& default_eye_m, const TrackedStateLimits& limits)
    : default_eye_m_(default_eye_m), limits_(limits) {}

bool TrackedStateTracker::take(const tracker::PoseSample& sample) {
    if (!sample.ok || sample.station < tracker::prop_station || sample.station > tracker::torch_station) {
        return true;
    }
    const std::optional<glm::dquat> rotation = geometry::normalised(sample.rotation);
    const glm::dvec3& p = sample.position_m;
    if (!rotation || !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        return false;
    }
    std::optional<Latest>& latest = sample.station == tracker::prop_station   ? prop_
                                    : sample.station == tracker::head_station ? head_
                                                                              : torch_;
    if (!latest || sample.time >= latest->time) {
        latest = Latest{{*rotation, p}, sample.time};
    }
    return true;
}

TrackedState TrackedStateTracker::at(MonotonicTime now) const {
    TrackedState tracked_state;
    tracked_state.time = now;
    tracked_state.eye_m = default_eye_m_;
    if (prop_) {
        tracked_state.table_from_prop = prop_->table_from_station;
        tracked_state.prop_age = now - prop_->time;
        tracked_state.prop_known = tracked_state.prop_age <= limits_.oldest_prop;
    }
    tracked_state.table_from_head = level_head(default_eye_m_, tracked_state.table_from_prop.translation);
    tracked_state.eyes_apart = 1.0;
    if (head_ && now - head_->time <= limits_.oldest_head) {
        tracked_state.eye_m = head_->table_from_station.translation;
        tracked_state.table_from_head = head_->table_from_station.rotation;
        tracked_state.head_known = true;
    }
    if (torch_ && now - torch_->time <= limits_.oldest_torch) {
        tracked_state.torches[0] = {torch_->table_from_station, 1.0, TorchPresence::InHand};
    }
    return tracked_state;
}

} // namespace frustumscreen::tracking
