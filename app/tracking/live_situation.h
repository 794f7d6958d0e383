/// What will be the case on the table when the picture is lit: the situation of a live tracker, smoothed and
/// predicted. An offline picture uses SituationTracker, which does neither.
///
/// Frames   table T, metres; samples too (registered_tracker.h).
/// Time     a sample counts from its own time on; `at(lit)` asks for the time at which the picture is lit.
/// Threads  values; one caller. Allocates nothing after construction.
#pragma once

#include "app/tracking/pose_estimator.h"
#include "app/tracking/shown_pose.h"
#include "app/tracking/situation.h"

namespace frustumscreen {

class LiveSituation {
public:
    /// `lever_m`: half the prop's height.
    LiveSituation(const glm::dvec3& default_eye_m, double lever_m);

    /// False: a sample that claims to be usable and is no pose, or that no hand can have brought about.
    bool take(const PoseSample& sample);
    /// A prop that is lost stays where it was, first in truth, then with `prop_known` false. The eye of a
    /// head that is lost glides to the default eye, and from there to a head that is found. Time does not go
    /// back from call to call.
    [[nodiscard]] Situation at(MonotonicTime lit);

private:
    /// The head, or the default eye in its place; a change between them is an reinitialisation.
    [[nodiscard]] PoseEstimate goal_of_eye(const PoseEstimate& head, bool known);

    glm::dvec3 default_eye_m_;
    PoseEstimator prop_;
    PoseEstimator head_;
    ShownPose shown_prop_;
    ShownPose shown_head_;
    bool eye_is_heads_ = false;   ///< else the default eye
    std::uint64_t eye_goals_ = 1; ///< so many until now; the default eye is the first
};

/// How long after `now`, at which a frame begins, its picture is lit: the display's own latency and what is
/// measured from the beginning of a frame until it was flipped, which is followed slowly.
class LightDelay {
public:
    explicit LightDelay(Nanoseconds display_latency) : display_latency_(display_latency) {}

    /// A frame that began at `now` was flipped at `flipped`. What cannot be a flip is held within 0 to 100
    /// ms.
    void flipped(MonotonicTime now, MonotonicTime flipped);
    [[nodiscard]] Nanoseconds from_now() const;

private:
    Nanoseconds display_latency_;
    double flip_s_ = 0.0;
};

} // namespace frustumscreen
