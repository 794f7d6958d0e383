/// Exponential, logarithm and interpolation of poses.
///
/// Frames   rotation vectors (axis times angle, radians) are in the frame that the pose maps to: table T.
/// Threads  pure; any.
/// Errors   none: quaternions are unit; both signs of a rotation give equal results.
/// Source   Sola, Deray and Atchuthan, A micro Lie theory for state estimation in robotics, 2018, SO(3).
#pragma once

#include "app/geometry/transform.h"

namespace frustumscreen::tracking {

/// The rotation about `vector` by its length.
[[nodiscard]] glm::dquat rotation_of(const glm::dvec3& vector);
/// The inverse of `rotation_of`: the shortest rotation vector, no longer than pi.
[[nodiscard]] glm::dvec3 rotation_vector(const glm::dquat& rotation);

/// A movement of a pose: first the rotation, then the shift, both in the table's axes.
struct PoseStep {
    glm::dvec3 shift_m{0.0};
    glm::dvec3 turn_rad{0.0};
};
[[nodiscard]] PoseStep step_between(const geometry::RigidTransform& from, const geometry::RigidTransform& to);
[[nodiscard]] geometry::RigidTransform moved(const geometry::RigidTransform& pose, const PoseStep& step);

/// 0 = `from`, 1 = `to`; the shift is linear, the rotation the shortest one at a constant rate (slerp).
[[nodiscard]] geometry::RigidTransform between(const geometry::RigidTransform& from,
                                               const geometry::RigidTransform& to, double share);

/// Bound of the displacement at `lever_m` from the prop's origin: shift plus rotation times the lever.
[[nodiscard]] double slip_m(const PoseStep& step, double lever_m);

} // namespace frustumscreen::tracking
