#include "app/bench/latency/one_euro.h"

namespace frustumscreen::bench {

namespace {

/// Weight of the new value in a first-order low-pass: alpha in the paper.
double share_of_new(double cutoff_hz, double dt_s) {
    const double time_constant_s = 1.0 / (2.0 * 3.14159265358979323846 * cutoff_hz);
    return 1.0 / (1.0 + time_constant_s / dt_s);
}

} // namespace

void OneEuroFilter::restart(const geometry::RigidTransform& measured) {
    measured_ = pose_ = measured;
    rate_ = {};
}

void OneEuroFilter::take(const geometry::RigidTransform& measured, double dt_s) {
    const tracking::PoseStep change = tracking::step_between(measured_, measured);
    measured_ = measured;
    const double rate_share = share_of_new(options_.derivative_cutoff_hz, dt_s);
    rate_.shift_m += rate_share * (change.shift_m / dt_s - rate_.shift_m);
    rate_.turn_rad += rate_share * (change.turn_rad / dt_s - rate_.turn_rad);
    const double place_hz = options_.min_cutoff_hz + options_.place_beta_per_m * glm::length(rate_.shift_m);
    const double turn_hz = options_.min_cutoff_hz + options_.turn_beta_per_rad * glm::length(rate_.turn_rad);
    const tracking::PoseStep off = tracking::step_between(pose_, measured);
    pose_ = tracking::moved(
        pose_, {share_of_new(place_hz, dt_s) * off.shift_m, share_of_new(turn_hz, dt_s) * off.turn_rad});
}

geometry::RigidTransform OneEuroFilter::ahead(double ahead_s) const {
    return tracking::moved(pose_, {ahead_s * rate_.shift_m, ahead_s * rate_.turn_rad});
}

} // namespace frustumscreen::bench
