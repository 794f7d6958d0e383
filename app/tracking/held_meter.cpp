#include "app/tracking/held_meter.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::tracking {

namespace {

constexpr double time_constant_s = 0.12;
constexpr double changes_within_s = 0.1;
/// In units of the noise: a prop on the table stays far below the first, and a hand that moves is above the second.
constexpr double stands_below = 3.0;
constexpr double held_above = 6.0;

glm::dvec3 up_in_prop(const geometry::RigidTransform& table_from_prop) {
    return glm::conjugate(table_from_prop.rotation) * glm::dvec3(0.0, 0.0, 1.0);
}

} // namespace

HeldMeter::HeldMeter(const PoseNoise& noise, double lever_m)
    : noise_m_(std::sqrt(noise.place_m * noise.place_m +
                         2.0 * lever_m * lever_m * noise.turn_rad * noise.turn_rad)),
      lever_m_(lever_m) {}

void HeldMeter::restart(const geometry::RigidTransform& measured) {
    mean_height_m_ = measured.translation.z;
    mean_up_ = up_in_prop(measured);
    scatter_m2_ = 0.0;
    share_ = 0.0;
}

void HeldMeter::take(const geometry::RigidTransform& measured, double dt_s) {
    const double newest = geometry::follow_share(dt_s, time_constant_s);
    const double rise_m = measured.translation.z - mean_height_m_;
    const glm::dvec3 tilt = up_in_prop(measured) - mean_up_;
    const double off_m2 = rise_m * rise_m + lever_m_ * lever_m_ * glm::dot(tilt, tilt);
    // The weighted mean and variance of all samples, each by its age.
    scatter_m2_ = (1.0 - newest) * (scatter_m2_ + newest * off_m2);
    mean_height_m_ += newest * rise_m;
    mean_up_ += newest * tilt;
    const double scatter = std::sqrt(scatter_m2_) / noise_m_;
    const double goal = geometry::ease((scatter - stands_below) / (held_above - stands_below));
    share_ += std::clamp(goal - share_, -dt_s / changes_within_s, dt_s / changes_within_s);
}

} // namespace frustumscreen::tracking
