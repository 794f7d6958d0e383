#include "app/tracking/steady_filter.h"

#include "app/geometry/time_curves.h"

namespace frustumscreen::tracking {

namespace {

/// Time constant of the measured velocity: a fifth of a tremor's passes.
constexpr double velocity_s = 0.08;

} // namespace

SteadyFilterOptions lamp_filter() {
    return {.place = {.calm_s = 0.25, .tremor = 0.008, .moves_from = 0.10, .moves_at = 0.40},
            .turn = {.calm_s = 0.25, .tremor = 0.04, .moves_from = 0.35, .moves_at = 1.0}};
}

void SteadyFilter::restart(const geometry::RigidTransform& measured) {
    measured_ = measured;
    pose_ = measured;
    place_ = {};
    turn_ = {};
}

double SteadyFilter::follow(const SteadyOptions& options, const glm::dvec3& step, const glm::dvec3& off,
                            double dt_s, Motion& motion) {
    motion.velocity += geometry::follow_share(dt_s, velocity_s) * (step / dt_s - motion.velocity);
    const double beyond = glm::length(off) / options.tremor;
    const double share = geometry::follow_share(dt_s, options.calm_s / (1.0 + beyond * beyond));
    motion.lag_s = dt_s * (1.0 - share) / share;
    return share;
}

void SteadyFilter::take(const geometry::RigidTransform& measured, double dt_s) {
    const PoseStep step = step_between(measured_, measured);
    const PoseStep off = step_between(pose_, measured);
    const double place = follow(options_.place, step.shift_m, off.shift_m, dt_s, place_);
    const double turn = follow(options_.turn, step.turn_rad, off.turn_rad, dt_s, turn_);
    pose_ = moved(pose_, {place * off.shift_m, turn * off.turn_rad});
    measured_ = measured;
}

glm::dvec3 SteadyFilter::way(const SteadyOptions& options, const Motion& motion, double ahead_s) {
    const double speed = glm::length(motion.velocity);
    const double counts =
        geometry::ease((speed - options.moves_from) / (options.moves_at - options.moves_from));
    return counts * (ahead_s + motion.lag_s) * motion.velocity;
}

geometry::RigidTransform SteadyFilter::ahead(double ahead_s) const {
    return moved(pose_, {way(options_.place, place_, ahead_s), way(options_.turn, turn_, ahead_s)});
}

} // namespace frustumscreen::tracking
