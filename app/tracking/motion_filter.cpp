#include "app/tracking/motion_filter.h"

#include "app/tracking/pose_math.h"

#include <cmath>

namespace frustumscreen {

namespace {

using Kind = MotionModel::Kind;

constexpr std::array place_models = {MotionModel{Kind::Rest, 0.0002}, MotionModel{Kind::Glide, 0.15},
                                     MotionModel{Kind::Manoeuvre, 12.0}};
constexpr std::array turn_models = {MotionModel{Kind::Rest, 0.0017}, MotionModel{Kind::Glide, 1.0},
                                    MotionModel{Kind::Manoeuvre, 60.0}};
constexpr std::array place_glide = {MotionModel{Kind::Glide, 0.8}};
constexpr std::array turn_glide = {MotionModel{Kind::Glide, 5.0}};

/// How far an acceleration that fades with time constant `lasts` carries in `ahead`.
double carried(double ahead, double lasts) {
    if (lasts <= 0.0) {
        return 0.0;
    }
    const double x = ahead / lasts;
    // x - 1 + exp(-x), without the cancellation where x is small.
    return lasts * lasts * (x < 1e-3 ? x * x * (0.5 - x / 6.0) : x + std::expm1(-x));
}

glm::dvec3 way(const MotionTrack& track, double ahead, double lasts) {
    return ahead * track.velocity() + carried(ahead, lasts) * track.acceleration();
}

} // namespace

MotionFilterOptions exhibit_filter(const PoseNoise& noise) {
    return {
        {place_models, noise.place_m, 0.3, 3.0, 1.0}, {turn_models, noise.turn_rad, 2.0, 20.0, 1.0}, 0.05};
}

MotionFilterOptions constant_velocity_filter(const PoseNoise& noise) {
    return {{place_glide, noise.place_m, 0.3, 0.0, 0.0}, {turn_glide, noise.turn_rad, 2.0, 0.0, 0.0}, 0.0};
}

MotionFilter::MotionFilter(const MotionFilterOptions& options)
    : place_(options.place), turn_(options.turn), acceleration_lasts_s_(options.acceleration_lasts_s) {}

void MotionFilter::restart(const RigidTransform& measured) {
    place_.restart();
    turn_.restart();
    pose_ = measured;
}

void MotionFilter::take(const RigidTransform& measured, double dt_s) {
    const PoseStep expected{place_.advance(dt_s), turn_.advance(dt_s)};
    pose_ = moved(pose_, expected);
    const PoseStep off = step_between(pose_, measured);
    pose_ = moved(pose_, {place_.correct(off.shift_m), turn_.correct(off.turn_rad)});
}

RigidTransform MotionFilter::ahead(double ahead_s) const {
    return moved(pose_,
                 {way(place_, ahead_s, acceleration_lasts_s_), way(turn_, ahead_s, acceleration_lasts_s_)});
}

} // namespace frustumscreen
