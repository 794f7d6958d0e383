#include "app/tracking/pose_estimator.h"

#include "app/geometry/time_curves.h"
#include "app/tracking/pose_math.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace frustumscreen::tracking {

namespace {

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

PoseEstimator::PoseEstimator(std::unique_ptr<PoseFilter> filter, const PoseEstimatorOptions& options)
    : filter_(std::move(filter)), options_(options) {}

const PoseEstimator::Moment& PoseEstimator::moment(std::size_t back) const {
    return history_[(next_ + remembered - 1 - back) % remembered];
}

void PoseEstimator::remember(const Moment& moment) {
    history_[next_] = moment;
    next_ = (next_ + 1) % remembered;
    count_ = std::min(count_ + 1, remembered);
    outliers_ = 0;
    late_ = 0;
}

Taken PoseEstimator::take_up(const Moment& measured) {
    filter_->restart(measured.pose);
    count_ = 0; // the pose between the samples is unknown
    remember(measured);
    restarted_ = measured.time;
    ++reinitialisations_;
    return Taken::Used;
}

bool PoseEstimator::plausible(const geometry::RigidTransform& expected,
                              const geometry::RigidTransform& measured, double dt_s) const {
    const PoseStep off = step_between(expected, measured);
    return glm::length(off.shift_m) <= options_.surprise_m + options_.speed_m_s * dt_s &&
           glm::length(off.turn_rad) <= options_.surprise_rad + options_.turn_rad_s * dt_s;
}

Taken PoseEstimator::doubt(const Moment& measured) {
    const double dt_s = to_seconds(measured.time - doubtful_.time);
    const bool agrees = outliers_ > 0 && dt_s > 0.0 && plausible(doubtful_.pose, measured.pose, dt_s);
    outliers_ = agrees ? outliers_ + 1 : 1;
    doubtful_ = measured;
    return outliers_ >= options_.convinced_by ? take_up(measured) : Taken::Outlier;
}

Taken PoseEstimator::take(MonotonicTime time, const geometry::RigidTransform& measured) {
    const std::optional<glm::dquat> rotation = geometry::normalised(measured.rotation);
    if (!rotation || !finite(measured.translation)) {
        return Taken::NoPose;
    }
    const Moment now{time, {*rotation, measured.translation}};
    if (count_ == 0) {
        return take_up(now);
    }
    const Nanoseconds step = time - moment(0).time;
    if (step == Nanoseconds(0)) {
        return Taken::Late;
    }
    if (step < Nanoseconds(0)) {
        return ++late_ >= options_.clock_set_back_by ? take_up(now) : Taken::Late;
    }
    const bool is_gap = step >= std::max(options_.gap_from, 5 * usual_interval() / 2);
    steps_ = {step, steps_[0]};
    if (step > options_.forgotten_after) {
        return take_up(now);
    }
    const double dt_s = to_seconds(step);
    if (!plausible(predicted(dt_s), now.pose, dt_s)) {
        return doubt(now);
    }
    filter_->take(now.pose, dt_s);
    reinitialisations_ += is_gap ? 1U : 0U;
    remember({time, filter_->ahead(0.0)});
    return Taken::Used;
}

geometry::RigidTransform PoseEstimator::predicted(double age_s) const {
    const double full_s = to_seconds(options_.predicted_for);
    const double stand_s = to_seconds(options_.stand_within);
    const double over_s = std::fmax(0.0, age_s - full_s);
    const double known =
        geometry::ease(to_seconds(moment(0).time - restarted_) / to_seconds(options_.learns_within));
    return filter_->ahead(known * (std::fmin(age_s, full_s) - stand_s * std::expm1(-over_s / stand_s)));
}

Nanoseconds PoseEstimator::stale_after() const {
    return std::max(options_.stale_after, std::min(5 * usual_interval() / 2, options_.stale_at_last));
}

PoseEstimate PoseEstimator::at(MonotonicTime time) const {
    if (count_ == 0) {
        return {};
    }
    PoseEstimate estimate{.pose = moment(0).pose,
                          .status = PoseStatus::Exact,
                          .age = time - moment(0).time,
                          .reinitialisations = reinitialisations_};
    if (options_.predicts && estimate.age > Nanoseconds(0)) {
        estimate.pose = predicted(to_seconds(estimate.age));
        estimate.status = PoseStatus::Predicted;
    } else if (options_.predicts) {
        std::tie(estimate.pose, estimate.status) = remembered_at(time);
    }
    if (estimate.age > stale_after()) {
        estimate.status = PoseStatus::Stale;
    }
    return estimate;
}

PoseSpread PoseEstimator::spread(MonotonicTime time) const {
    return count_ > 0 ? filter_->spread(std::fmax(0.0, to_seconds(time - moment(0).time))) : PoseSpread{};
}

std::pair<geometry::RigidTransform, PoseStatus> PoseEstimator::remembered_at(MonotonicTime time) const {
    std::size_t back = 0;
    while (back + 1 < count_ && moment(back).time > time) {
        ++back;
    }
    const Moment& before = moment(back);
    if (before.time > time) {
        return {before.pose, PoseStatus::Stale};
    }
    if (before.time == time) {
        return {before.pose, PoseStatus::Exact};
    }
    const Moment& after = moment(back - 1);
    const double share = to_seconds(time - before.time) / to_seconds(after.time - before.time);
    return {between(before.pose, after.pose, share), PoseStatus::Interpolated};
}

} // namespace frustumscreen::tracking
