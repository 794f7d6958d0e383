#include "app/room/moving_pose.h"

#include "app/geometry/time_curves.h"

#include <cmath>

namespace frustumscreen::room {

glm::dquat same_side(const glm::dquat& q, const glm::dquat& near_to) {
    return glm::dot(q, near_to) < 0.0 ? -q : q;
}

glm::dquat turned_between(const glm::dquat& a, const glm::dquat& b, double share) {
    const glm::dquat turn = glm::conjugate(a) * b;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    const double half = std::atan2(sine, turn.w); // 0 to a half turn
    if (sine < 1e-12) {                           // no turn, or a whole one about any axis
        return turn.w > 0.0 ? b : a * glm::angleAxis(2.0 * half * share, glm::dvec3(0.0, 0.0, 1.0));
    }
    return glm::normalize(a * glm::angleAxis(2.0 * half * share, axis / sine));
}

const geometry::RigidTransform& MovingPose::step(MonotonicTime now, const geometry::RigidTransform& pose,
                                                 bool source) {
    const geometry::RigidTransform before = pose_;
    if (!source_) {
        since_ = now - glides;
    } else if (*source_ != source) {
        from_ = before;
        since_ = now;
    }
    pose_ = pose;
    if (source_) {
        pose_.rotation = same_side(pose.rotation, before.rotation);
    }
    source_ = source;
    if (now - since_ < glides) {
        const double share = geometry::ease(to_seconds(now - since_) / to_seconds(glides));
        pose_.rotation = turned_between(from_.rotation, pose_.rotation, share);
        pose_.translation = glm::mix(from_.translation, pose_.translation, share);
    }
    return pose_;
}

} // namespace frustumscreen::room
