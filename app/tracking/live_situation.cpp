#include "app/tracking/live_situation.h"

#include "app/geometry/time_curves.h"
#include "app/tracking/motion_filter.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr double longest_flip_s = 0.1;
/// The lever is 0, because only the place of the head counts and not its turn.
constexpr double head_lever_m = 0.0;

PoseEstimator estimator() {
    return PoseEstimator(std::make_unique<MotionFilter>(exhibit_filter()));
}

} // namespace

LiveSituation::LiveSituation(const glm::dvec3& default_eye_m, double lever_m)
    : default_eye_m_(default_eye_m), prop_(estimator()), head_(estimator()),
      shown_prop_({.lever_m = lever_m}), shown_head_({.lever_m = head_lever_m}) {}

bool LiveSituation::take(const PoseSample& sample) {
    if (!sample.ok || (sample.station != prop_station && sample.station != head_station)) {
        return true;
    }
    PoseEstimator& estimator = sample.station == prop_station ? prop_ : head_;
    const RigidTransform table_from_station{sample.rotation, sample.position_m}; // perhaps not unit
    const Taken taken = estimator.take(sample.time, table_from_station);
    return taken == Taken::Used || taken == Taken::Late;
}

Situation LiveSituation::at(MonotonicTime lit) {
    Situation situation;
    situation.time = lit;
    const PoseEstimate prop = prop_.at(lit);
    if (prop.reinitialisations > 0) {
        situation.table_from_prop = shown_prop_.follow(prop, lit);
        situation.prop_age = prop.age;
        situation.prop_known = prop.status != PoseStatus::Stale;
    }
    const PoseEstimate head = head_.at(lit);
    situation.head_known = head.reinitialisations > 0 && head.status != PoseStatus::Stale;
    situation.eye_m = shown_head_.follow(goal_of_eye(head, situation.head_known), lit).translation;
    return situation;
}

PoseEstimate LiveSituation::goal_of_eye(const PoseEstimate& head, bool known) {
    if (known != eye_is_heads_) {
        eye_is_heads_ = known;
        ++eye_goals_;
    }
    PoseEstimate goal = head;
    if (!known) {
        goal.pose = {{1.0, 0.0, 0.0, 0.0}, default_eye_m_};
        goal.status = PoseStatus::Exact;
    }
    goal.reinitialisations += eye_goals_;
    return goal;
}

void LightDelay::flipped(MonotonicTime now, MonotonicTime flipped) {
    const double share = last_ ? follow_share(to_seconds(now - *last_), time_constant_s) : 1.0;
    flip_s_ += share * (std::clamp(to_seconds(flipped - now), 0.0, longest_flip_s) - flip_s_);
    last_ = last_ ? std::max(*last_, now) : now;
}

Nanoseconds LightDelay::from_now() const {
    return display_latency_ + Nanoseconds(std::llround(flip_s_ * 1e9));
}

} // namespace frustumscreen
