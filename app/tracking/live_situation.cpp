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

/// What no filter sees of the tracker: its registration, and its field bent by metal. Polhemus calls poses with a distortion that it
/// reports wrong by some millimetres.
constexpr double tracker_off_m = 0.0005;
constexpr double metal_off_m = 0.006;
/// The same of tags: where the camera is, how the tags were glued.
constexpr double tags_off_m = 0.0015;
/// A tracker of 30 Hz is at most 90 ms old when the picture is lit; tags, at 8 Hz on a slow processor, 230 ms.
constexpr Nanoseconds tracker_lost_after = std::chrono::milliseconds(150);
constexpr Nanoseconds tags_lost_after = std::chrono::milliseconds(300);

PoseEstimator estimator() {
    return PoseEstimator(std::make_unique<MotionFilter>(exhibit_filter()));
}

} // namespace

LiveSituation::LiveSituation(const glm::dvec3& default_eye_m, double lever_m)
    : default_eye_m_(default_eye_m), prop_(estimator()), tags_(estimator()), head_(estimator()),
      lever_m_(lever_m), hand_over_({.lever_m = lever_m}), shown_prop_({.lever_m = lever_m}),
      shown_head_({.lever_m = head_lever_m}) {}

bool LiveSituation::take(const PoseSample& sample) {
    if (!sample.ok || (sample.station != prop_station && sample.station != head_station)) {
        return true;
    }
    PoseEstimator& estimator = sample.station == prop_station ? prop_ : head_;
    const RigidTransform table_from_station{sample.rotation, sample.position_m}; // perhaps not unit
    const Taken taken = estimator.take(sample.time, table_from_station);
    return taken == Taken::Used || taken == Taken::Late;
}

bool LiveSituation::take_tags(const UncertainPose& pose) {
    const Taken taken = tags_.take(pose.time, pose.table_from_prop);
    if (taken == Taken::Used) {
        tags_sd_m_ = pose.place_sd_m + lever_m_ * pose.turn_sd_rad;
    }
    return taken == Taken::Used || taken == Taken::Late;
}

SourcePose LiveSituation::by_tracker(MonotonicTime lit) const {
    const PoseSpread spread = prop_.spread(lit);
    const double metal = health_ == TrackerHealth::MetalNear ? metal_off_m : 0.0;
    const glm::dvec3 parts(spread.place_m + lever_m_ * spread.turn_rad, tracker_off_m, metal);
    return {prop_.at(lit), glm::length(parts), tracker_lost_after};
}

SourcePose LiveSituation::by_tags(MonotonicTime lit) const {
    const PoseSpread spread = tags_.spread(lit);
    const glm::dvec3 parts(spread.place_m + lever_m_ * spread.turn_rad, tags_off_m, tags_sd_m_);
    return {tags_.at(lit), glm::length(parts), tags_lost_after};
}

Situation LiveSituation::at(MonotonicTime lit) {
    Situation situation;
    situation.time = lit;
    const PoseEstimate prop = hand_over_.follow(by_tracker(lit), by_tags(lit), lit);
    situation.by_tags = hand_over_.leader() == Source::Tags;
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
