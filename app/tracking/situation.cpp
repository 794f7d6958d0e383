#include "app/tracking/situation.h"

#include <cmath>

namespace frustumscreen {

SituationTracker::SituationTracker(const glm::dvec3& default_eye_m, const SituationLimits& limits)
    : default_eye_m_(default_eye_m), limits_(limits) {}

bool SituationTracker::take(const PoseSample& sample) {
    if (!sample.ok || (sample.station != prop_station && sample.station != head_station)) {
        return true;
    }
    const std::optional<glm::dquat> rotation = normalised(sample.rotation);
    const glm::dvec3& p = sample.position_m;
    if (!rotation || !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        return false;
    }
    std::optional<Latest>& latest = sample.station == prop_station ? prop_ : head_;
    if (!latest || sample.time >= latest->time) {
        latest = Latest{{*rotation, p}, sample.time};
    }
    return true;
}

Situation SituationTracker::at(MonotonicTime now) const {
    Situation situation;
    situation.time = now;
    situation.eye_m = default_eye_m_;
    if (prop_) {
        situation.table_from_prop = prop_->table_from_station;
        situation.prop_age = now - prop_->time;
        situation.prop_known = situation.prop_age <= limits_.oldest_prop;
    }
    if (head_ && now - head_->time <= limits_.oldest_head) {
        situation.eye_m = head_->table_from_station.translation;
        situation.head_known = true;
    }
    return situation;
}

} // namespace frustumscreen
