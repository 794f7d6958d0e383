/// Exponential, logarithm and interpolation of poses.
///
/// Frames   rotation vectors (axis times angle, radians) are in the frame that the pose maps into: table T.
/// Threads  pure; any.
/// Errors   none: quaternions are unit; the two signs of one rotation give the same result.
/// Source   Sola, Deray and Atchuthan, A micro Lie theory for state estimation in robotics, 2018, SO(3).
#pragma once

#include "app/geometry/transform.h"

namespace frustumscreen {

/// The rotation about `vector` by its length.
[[nodiscard]] glm::dquat rotation_of(const glm::dvec3& vector);
/// Its inverse: the shortest such vector, no longer than pi.
[[nodiscard]] glm::dvec3 rotation_vector(const glm::dquat& rotation);

/// A movement of a pose: first the turn, then the shift, both in the table's axes.
struct PoseStep {
    glm::dvec3 shift_m{0.0};
    glm::dvec3 turn_rad{0.0};
};
[[nodiscard]] PoseStep step_between(const RigidTransform& from, const RigidTransform& to);
[[nodiscard]] RigidTransform moved(const RigidTransform& pose, const PoseStep& step);

/// 0 = `from`, 1 = `to`; the shift is straight, the turn the shortest at a constant rate (slerp).
[[nodiscard]] RigidTransform between(const RigidTransform& from, const RigidTransform& to, double share);

/// How far a point may be off at `lever_m` from the origin of the prop: shift plus turn times the lever.
[[nodiscard]] double slip_m(const PoseStep& step, double lever_m);

} // namespace frustumscreen
