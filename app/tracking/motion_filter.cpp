#include "app/tracking/motion_filter.h"

#include "app/tracking/pose_math.h"

#include <cmath>

namespace frustumscreen::tracking {

namespace {

using Kind = MotionModel::Kind;

// Creep is tight, so the picture does not tremble on a slowly sliding prop. Glide is loose, as the model of a
// knock. Manoeuvre mostly explains a moving hand.
constexpr std::array place_models = {MotionModel{Kind::Rest, 0.0001}, MotionModel{Kind::Creep, 0.0125, 0.45},
                                     MotionModel{Kind::Glide, 3.0}, MotionModel{Kind::Manoeuvre, 7.4}};
constexpr std::array turn_models = {MotionModel{Kind::Rest, 0.0003}, MotionModel{Kind::Glide, 0.02},
                                    MotionModel{Kind::Manoeuvre, 5.7}};
constexpr std::array hand_place_models = {MotionModel{Kind::Glide, 0.049}, MotionModel{Kind::Manoeuvre, 4.2},
                                          MotionModel{Kind::Manoeuvre, 29.0}};
constexpr std::array hand_turn_models = {MotionModel{Kind::Glide, 2.7}, MotionModel{Kind::Manoeuvre, 4.9},
                                         MotionModel{Kind::Manoeuvre, 16.6}};
constexpr std::array place_glide = {MotionModel{Kind::Glide, 0.1}};
constexpr std::array turn_glide = {MotionModel{Kind::Glide, 0.3}};

/// Time in which a steady motion covers the distance of one that decays with time constant `lasts_s` in
/// `ahead_s`.
double faded(double ahead_s, double lasts_s) {
    return lasts_s > 0.0 ? -lasts_s * std::expm1(-ahead_s / lasts_s) : ahead_s;
}

/// The same for the distance covered by a steady acceleration.
double acceleration_faded(double ahead_s, double lasts_s) {
    return lasts_s > 0.0 ? lasts_s * (ahead_s - faded(ahead_s, lasts_s)) : 0.5 * ahead_s * ahead_s;
}

glm::dvec3 way(const MotionTrack& track, double ahead_s, double manoeuvre_lasts_s, const Coasting& coasts) {
    const double t = glm::mix(ahead_s, faded(ahead_s, manoeuvre_lasts_s), track.manoeuvring());
    return faded(t, coasts.velocity_s) * track.velocity() +
           acceleration_faded(t, coasts.acceleration_s) * track.acceleration();
}

} // namespace

MotionFilterOptions exhibit_filter(const PoseNoise& noise) {
    return {.place = {place_models, noise.place_m, 0.065, 2.0, 0.02},
            .turn = {turn_models, noise.turn_rad, 0.18, 5.0, 0.8},
            .manoeuvre_lasts_s = 0.078};
}

MotionFilterOptions hand_filter(const PoseNoise& noise) {
    return {.place = {hand_place_models, noise.place_m, 0.5, 3.0, 1.16},
            .turn = {hand_turn_models, noise.turn_rad, 2.0, 20.0, 0.57},
            .place_coasts = {.velocity_s = 0.28, .acceleration_s = 0.03},
            .turn_coasts = {.velocity_s = 0.04, .acceleration_s = 0.004}};
}

MotionFilterOptions constant_velocity_filter(const PoseNoise& noise) {
    return {.place = {place_glide, noise.place_m, 0.3, 0.0, 0.0},
            .turn = {turn_glide, noise.turn_rad, 2.0, 0.0, 0.0}};
}

MotionFilter::MotionFilter(const MotionFilterOptions& options)
    : place_(options.place), turn_(options.turn), manoeuvre_lasts_s_(options.manoeuvre_lasts_s),
      place_coasts_(options.place_coasts), turn_coasts_(options.turn_coasts) {}

void MotionFilter::restart(const geometry::RigidTransform& measured) {
    place_.restart();
    turn_.restart();
    pose_ = measured;
}

void MotionFilter::take(const geometry::RigidTransform& measured, double dt_s) {
    const PoseStep expected{place_.advance(dt_s), turn_.advance(dt_s)};
    pose_ = moved(pose_, expected);
    const PoseStep off = step_between(pose_, measured);
    pose_ = moved(pose_, {place_.correct(off.shift_m), turn_.correct(off.turn_rad)});
}

geometry::RigidTransform MotionFilter::ahead(double ahead_s) const {
    return moved(pose_, {way(place_, ahead_s, manoeuvre_lasts_s_, place_coasts_),
                         way(turn_, ahead_s, manoeuvre_lasts_s_, turn_coasts_)});
}

} // namespace frustumscreen::tracking
