#include "app/tracking/situation.h"

namespace frustumscreen {

SituationTracker::SituationTracker(const RigidTransform& table_from_device, const glm::dvec3& default_eye_m,
                                   const SituationLimits& limits)
    : table_from_device_(table_from_device), default_eye_m_(default_eye_m), limits_(limits) {}

void SituationTracker::take(const PoseSample& sample) {
    if (!sample.ok || (sample.station != prop_station && sample.station != head_station)) {
        return;
    }
    std::optional<Latest>& latest = sample.station == prop_station ? prop_ : head_;
    if (latest && sample.time < latest->time) {
        return;
    }
    latest = Latest{table_from_device_ * RigidTransform{sample.rotation, sample.position_m}, sample.time};
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
