#include "app/tracking/live_tracked_state.h"

#include "app/geometry/time_curves.h"
#include "app/tracking/held_filter.h"
#include "app/tracking/level_head.h"
#include "app/tracking/motion_filter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::tracking {

namespace {

constexpr double longest_flip_s = 0.1;
/// The lever of the point between the eyes is 0: the head's turn does not move it.
constexpr double head_lever_m = 0.0;

/// Errors that a filter cannot see: the tracker's registration, and its field bent by metal. Polhemus states
/// that poses with a reported distortion are wrong by some millimetres.
constexpr double tracker_off_m = 0.0005;
constexpr double metal_off_m = 0.006;
/// As above, for tags: the camera's position, and how the tags were glued.
constexpr double tags_off_m = 0.0015;
/// A tracker of 30 Hz is at most 90 ms old when the picture is lit; tags at 8 Hz, on a slow processor, 230
/// ms.
constexpr Nanoseconds tracker_lost_after = std::chrono::milliseconds(150);
constexpr Nanoseconds tags_lost_after = std::chrono::milliseconds(300);

/// As tracker_lost_after, for torches; a lamp's tag is covered now and then.
constexpr Nanoseconds torch_lost_after = std::chrono::milliseconds(250);
constexpr Nanoseconds lamp_lost_after = std::chrono::milliseconds(600);

/// A brisk hand. A prop that was lost and found elsewhere is not followed faster.
constexpr double fastest_return_m_s = 1.0;

/// Heads seen by a camera scatter more than sensors, and move less than hands.
constexpr std::array seen_head_models = {MotionModel{MotionModel::Kind::Rest, 0.004},
                                         MotionModel{MotionModel::Kind::Glide, 1.0}};

MotionFilterOptions seen_head_filter() {
    constexpr double scatter_m = 0.010;
    MotionFilterOptions options = exhibit_filter();
    options.place = {.models = seen_head_models,
                     .measured_sd = scatter_m,
                     .first_velocity_sd = 0.5,
                     .first_acceleration_sd = 0.0,
                     .changes_per_s = 0.2};
    return options;
}

PoseEstimatorOptions seen_head_options() {
    PoseEstimatorOptions options;
    options.surprise_m = 0.12; // the distance from the camera is the least certain
    options.forgotten_after = std::chrono::milliseconds(600);
    return options;
}

PoseEstimator estimator() {
    return PoseEstimator(std::make_unique<MotionFilter>(exhibit_filter()));
}

/// The prop by its tracker.
PoseEstimator prop_estimator(double lever_m, PropMotion motion) {
    if (motion == PropMotion::OnTable) {
        return estimator();
    }
    return PoseEstimator(std::make_unique<HeldFilter>(PoseNoise{}, lever_m));
}

} // namespace

LiveTrackedState::LiveTrackedState(const glm::dvec3& default_eye_m, double lever_m, const TwoEyes& two_eyes,
                                   PropMotion motion, const TorchSources& torches)
    : default_eye_m_(default_eye_m), prop_(prop_estimator(lever_m, motion)), tags_(estimator()),
      head_(estimator()), visitor_(std::make_unique<MotionFilter>(seen_head_filter()), seen_head_options()),
      lever_m_(lever_m), source_arbiter_({.lever_m = lever_m}),
      shown_prop_({.lever_m = lever_m, .fastest_m_s = fastest_return_m_s}),
      shown_head_({.lever_m = head_lever_m}), two_eyes_(two_eyes),
      shown_turn_({.lever_m = two_eyes.half_apart_m}), eyes_apart_(two_eyes.fixed_viewer) {
    if (torches.tracker) {
        torches_[0].emplace(SteadyFilterOptions{}, torch_lost_after);
    }
    if (torches.camera) {
        torches_[1].emplace(lamp_filter(), lamp_lost_after);
    }
}

bool LiveTrackedState::take(const tracker::PoseSample& sample) {
    if (sample.ok && sample.station == tracker::torch_station && torches_[0]) {
        const Taken torch = torches_[0]->take(sample.time, {sample.rotation, sample.position_m});
        return torch == Taken::Used || torch == Taken::Late;
    }
    if (!sample.ok || (sample.station != tracker::prop_station && sample.station != tracker::head_station)) {
        return true;
    }
    PoseEstimator& estimator = sample.station == tracker::prop_station ? prop_ : head_;
    const geometry::RigidTransform table_from_station{sample.rotation, sample.position_m}; // perhaps not unit
    const Taken taken = estimator.take(sample.time, table_from_station);
    if (taken == Taken::Used && sample.station == tracker::head_station && two_eyes_.half_apart_m > 0.0) {
        glasses_worn_ = glasses_.worn(sample.time, {glm::normalize(sample.rotation), sample.position_m});
    }
    return taken == Taken::Used || taken == Taken::Late;
}

bool LiveTrackedState::take_tags(const UncertainPose& pose) {
    const Taken taken = tags_.take(pose.time, pose.table_from_prop);
    if (taken == Taken::Used) {
        tags_sd_m_ = pose.place_sd_m + lever_m_ * pose.turn_sd_rad;
    }
    return taken == Taken::Used || taken == Taken::Late;
}

bool LiveTrackedState::take_lamp(const UncertainPose& pose) {
    const Taken taken = torches_[1] ? torches_[1]->take(pose.time, pose.table_from_prop) : Taken::Late;
    return taken == Taken::Used || taken == Taken::Late;
}

/// The point that visitors look at.
glm::dvec3 LiveTrackedState::middle_of_prop() const {
    return prop_is_at_.point({0.0, 0.0, lever_m_});
}

bool LiveTrackedState::take_visitor(const SeenHead& head) {
    if (active_visitor_.see(head, middle_of_prop())) {
        visitor_.forget();
    }
    if (active_visitor_.person() != head.person) {
        return true;
    }
    const Taken taken = visitor_.take(head.time, {{1.0, 0.0, 0.0, 0.0}, head.middle_m});
    if (taken == Taken::Used) {
        visitor_sd_m_ = head.across_sd_m;
    }
    return taken != Taken::NoPose;
}

SourcePose LiveTrackedState::by_tracker(MonotonicTime lit) const {
    const PoseSpread spread = prop_.spread(lit);
    const double metal = health_ == tracker::TrackerHealth::MetalNear ? metal_off_m : 0.0;
    const glm::dvec3 parts(spread.place_m + lever_m_ * spread.turn_rad, tracker_off_m, metal);
    return {prop_.at(lit), glm::length(parts), tracker_lost_after};
}

SourcePose LiveTrackedState::by_tags(MonotonicTime lit) const {
    const PoseSpread spread = tags_.spread(lit);
    const glm::dvec3 parts(spread.place_m + lever_m_ * spread.turn_rad, tags_off_m, tags_sd_m_);
    return {tags_.at(lit), glm::length(parts), tags_lost_after};
}

TrackedState LiveTrackedState::at(MonotonicTime lit) {
    TrackedState tracked_state;
    tracked_state.time = lit;
    const PoseEstimate prop = source_arbiter_.follow(by_tracker(lit), by_tags(lit), lit);
    tracked_state.by_tags = source_arbiter_.leader() == Source::Tags;
    if (prop.reinitialisations > 0) {
        tracked_state.table_from_prop = shown_prop_.follow(prop, lit);
        tracked_state.prop_age = prop.age;
        tracked_state.prop_known = prop.status != PoseStatus::Stale;
    }
    prop_is_at_ = tracked_state.table_from_prop;
    look_for_eye(tracked_state);
    for (std::size_t k = 0; k < torches_.size(); ++k) {
        if (torches_.at(k)) {
            tracked_state.torches.at(k) = torches_.at(k)->at(lit);
        }
    }
    return tracked_state;
}

void LiveTrackedState::look_for_eye(TrackedState& tracked_state) {
    const auto is_known = [](const PoseEstimate& estimate) {
        return estimate.reinitialisations > 0 && estimate.status != PoseStatus::Stale;
    };
    const PoseEstimate head = head_.at(tracked_state.time);
    const PoseEstimate visitor = visitor_.at(tracked_state.time);
    tracked_state.head_known = is_known(head);
    tracked_state.head_seen = !tracked_state.head_known && is_known(visitor);
    glm::dvec3 eye_m = default_eye_m_;
    EyeOf of = EyeOf::Default;
    if (tracked_state.head_known) {
        of = EyeOf::Sensor;
        eye_m = head.pose.translation;
    } else if (tracked_state.head_seen) {
        of = EyeOf::SeenHead;
        eye_m = eye_of_head(visitor.pose.translation, middle_of_prop());
        tracked_state.eye_sd_m = std::hypot(visitor_.spread(tracked_state.time).place_m, visitor_sd_m_);
    }
    PoseEstimate goal{.pose = {{1.0, 0.0, 0.0, 0.0}, eye_m},
                      .status = PoseStatus::Exact,
                      .age = Nanoseconds(0),
                      .reinitialisations = 0};
    eye_goals_ += of != eye_of_ ? 1 : 0;
    eye_of_ = of;
    goal.reinitialisations = head.reinitialisations + visitor.reinitialisations + eye_goals_;
    tracked_state.eye_m = shown_head_.follow(goal, tracked_state.time).translation;
    if (two_eyes_.half_apart_m > 0.0) {
        look_for_turn(head, goal, tracked_state);
    }
}

void LiveTrackedState::look_for_turn(const PoseEstimate& head, const PoseEstimate& goal,
                                     TrackedState& tracked_state) {
    bool both = two_eyes_.fixed_viewer || tracked_state.head_seen;
    PoseEstimate turn = goal; // glides when the eye does
    turn.pose = {level_head(tracked_state.eye_m, tracked_state.table_from_prop.translation), glm::dvec3(0.0)};
    if (tracked_state.head_known) {
        both = glasses_worn_ || !two_eyes_.glasses_may_lie;
        turn.pose.rotation = head.pose.rotation;
    } else {
        glasses_.forget();
    }
    tracked_state.table_from_head = shown_turn_.follow(turn, tracked_state.time).rotation;
    tracked_state.eyes_apart = eyes_apart_.follow(tracked_state.time, both);
}

void LightDelay::flipped(MonotonicTime now, MonotonicTime flipped) {
    const double share = last_ ? geometry::follow_share(to_seconds(now - *last_), time_constant_s) : 1.0;
    flip_s_ += share * (std::clamp(to_seconds(flipped - now), 0.0, longest_flip_s) - flip_s_);
    last_ = last_ ? std::max(*last_, now) : now;
}

Nanoseconds LightDelay::from_now() const {
    return display_latency_ + Nanoseconds(std::llround(flip_s_ * 1e9));
}

} // namespace frustumscreen::tracking
