#include "app/tracking/source_arbiter.h"

#include "app/geometry/time_curves.h"

#include <algorithm>

namespace frustumscreen::tracking {

namespace {

/// Largest slope of `ease`.
constexpr double steepest = 1.5;

bool is_seen(const PoseEstimate& estimate) {
    return estimate.reinitialisations > 0;
}

bool is_lost(const SourcePose& source) {
    return !is_seen(source.estimate) || source.estimate.status == PoseStatus::Stale ||
           source.estimate.age > source.lost_after;
}

} // namespace

bool SourceArbiter::gives_way(const SourcePose& leading, const SourcePose& other, MonotonicTime time) {
    if (is_lost(other)) {
        better_since_.reset();
        return false;
    }
    if (is_lost(leading)) {
        return true;
    }
    if (options_.clearly * other.sd_m >= leading.sd_m) {
        better_since_.reset();
        return false;
    }
    better_since_ = better_since_.value_or(time);
    return time - *better_since_ >= options_.dwell;
}

geometry::RigidTransform SourceArbiter::shown(const PoseEstimate& leading, MonotonicTime time) const {
    const double gone = fades_s_ > 0.0 ? geometry::ease(to_seconds(time - changed_) / fades_s_) : 1.0;
    if (gone >= 1.0) {
        return leading.pose;
    }
    return moved(leading.pose, {(1.0 - gone) * left_.shift_m, (1.0 - gone) * left_.turn_rad});
}

void SourceArbiter::change(const PoseEstimate& leading, const PoseEstimate& other, MonotonicTime time) {
    const bool known = is_seen(leading) && leading.status != PoseStatus::Stale;
    if (known) {
        left_ = step_between(other.pose, shown(leading, time));
        const double slip = slip_m(left_, options_.lever_m);
        fades_s_ = std::clamp(steepest * slip / options_.fastest_m_s, to_seconds(options_.shortest),
                              to_seconds(options_.longest));
    } else {
        fades_s_ = 0.0;
        ++reinitialisations_;
    }
    changed_ = time;
    seen_ = other.reinitialisations;
    leader_ = leader_ == Source::Tracker ? Source::Tags : Source::Tracker;
    better_since_.reset();
    ++changes_;
}

PoseEstimate SourceArbiter::follow(const SourcePose& tracker, const SourcePose& tags, MonotonicTime time) {
    const std::array<const SourcePose*, 2> sources{&tracker, &tags};
    const auto leads = static_cast<std::size_t>(leader_);
    if (gives_way(*sources[leads], *sources[1 - leads], time)) {
        change(sources[leads]->estimate, sources[1 - leads]->estimate, time);
    }
    PoseEstimate estimate = sources[static_cast<std::size_t>(leader_)]->estimate;
    if (estimate.reinitialisations != seen_) { // the leader itself reinitialises, perhaps with a jump
        seen_ = estimate.reinitialisations;
        fades_s_ = 0.0;
        ++reinitialisations_;
    }
    estimate.reinitialisations = reinitialisations_;
    estimate.pose = shown(estimate, time);
    return estimate;
}

} // namespace frustumscreen::tracking
