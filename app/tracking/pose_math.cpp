#include "app/tracking/pose_math.h"

#include <cmath>

namespace frustumscreen::tracking {

namespace {

/// Below this, sin(x) / x and x / tan(x) equal the first terms of their series to the last bit.
constexpr double small_angle = 1e-8;

} // namespace

glm::dquat rotation_of(const glm::dvec3& vector) {
    const double angle = glm::length(vector);
    const double sine_share = angle > small_angle ? std::sin(0.5 * angle) / angle : 0.5;
    return {std::cos(0.5 * angle), sine_share * vector.x, sine_share * vector.y, sine_share * vector.z};
}

glm::dvec3 rotation_vector(const glm::dquat& rotation) {
    const double sign = rotation.w < 0.0 ? -1.0 : 1.0;
    const glm::dvec3 axis = sign * glm::dvec3(rotation.x, rotation.y, rotation.z);
    const double sine = glm::length(axis);
    const double angle = 2.0 * std::atan2(sine, sign * rotation.w);
    return (sine > small_angle ? angle / sine : 2.0) * axis;
}

PoseStep step_between(const geometry::RigidTransform& from, const geometry::RigidTransform& to) {
    return {to.translation - from.translation, rotation_vector(to.rotation * glm::conjugate(from.rotation))};
}

geometry::RigidTransform moved(const geometry::RigidTransform& pose, const PoseStep& step) {
    return {glm::normalize(rotation_of(step.turn_rad) * pose.rotation), pose.translation + step.shift_m};
}

geometry::RigidTransform between(const geometry::RigidTransform& from, const geometry::RigidTransform& to,
                                 double share) {
    const PoseStep step = step_between(from, to);
    return moved(from, {share * step.shift_m, share * step.turn_rad});
}

double slip_m(const PoseStep& step, double lever_m) {
    return glm::length(step.shift_m) + lever_m * glm::length(step.turn_rad);
}

} // namespace frustumscreen::tracking
