/// Interpolates between two rotations, and follows a pose whose source may change without ever jumping.
///
/// Frames   any, the same one in all calls; metres.
/// Threads  values; one caller. Nothing allocates.
/// Errors   none: every finite input gives a finite pose.
#pragma once

#include "app/geometry/transform.h"
#include "firmware_host/base/time.h"

#include <optional>

namespace frustumscreen::room {

/// The one of `q` and -q that is nearer to `near_to`.
[[nodiscard]] glm::dquat same_side(const glm::dquat& q, const glm::dquat& near_to);

/// From `a` (share 0) to `b` (share 1) about one axis, at an even speed; the quaternions' signs decide which way
/// round, up to a whole turn.
[[nodiscard]] glm::dquat turned_between(const glm::dquat& a, const glm::dquat& b, double share);

/// A pose from one of two sources. When the source changes, the pose glides from where it was to where the new source has it.
class MovingPose {
public:
    static constexpr Nanoseconds glides = std::chrono::milliseconds(600);

    /// `source`: of this step's `pose`.
    const geometry::RigidTransform& step(MonotonicTime now, const geometry::RigidTransform& pose,
                                         bool source);
    /// As of the latest step. The rotation's sign continues that of the step before.
    [[nodiscard]] const geometry::RigidTransform& pose() const { return pose_; }

private:
    std::optional<bool> source_; ///< none: before the first step
    geometry::RigidTransform from_;
    MonotonicTime since_;
    geometry::RigidTransform pose_;
};

} // namespace frustumscreen::room
