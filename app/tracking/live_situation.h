/// Prop pose and eye at the time at which the picture is lit: a live tracker's samples, smoothed and
/// predicted. An offline picture uses SituationTracker, which does neither.
///
/// Tags     a second tracker of the prop, which may be there. Each of the two has an estimator of its own; hand_over.h says whose
///          pose is shown.
/// Visitor  heads that a camera sees, with nothing on them. While no sensor says where the visitor's head is, the eye is that of
///          whoever holds the prop (holder.h); from one person to another it glides.
/// Frames   table T, metres; samples too (registered_tracker.h).
/// Time     a sample counts from its own time on; `at(lit)` asks for the time at which the picture is lit.
/// Threads  values; one caller. Allocates nothing after construction.
#pragma once

#include "app/tracking/hand_over.h"
#include "app/tracking/holder.h"
#include "app/tracking/pose_estimator.h"
#include "app/tracking/shown_pose.h"
#include "app/tracking/situation.h"
#include "app/tracking/uncertain_pose.h"

#include <optional>

namespace frustumscreen {

class LiveSituation {
public:
    /// `lever_m`: half the prop's height.
    LiveSituation(const glm::dvec3& default_eye_m, double lever_m);

    /// Returns false for a sample that claims to be usable but is not a pose, or moves as no hand can.
    bool take(const PoseSample& sample);
    /// The same of the tags' poses.
    bool take_tags(const UncertainPose& pose);
    /// A head in the order of its time. Returns false for one that is no place.
    bool take_visitor(const SeenHead& head);
    /// How the tracker itself is, from now on; metal near it makes its poses less sure.
    void tracker_is(TrackerHealth health) { health_ = health; }
    /// How often the tags took over from the tracker, or it from them.
    [[nodiscard]] std::uint64_t hand_overs() const { return hand_over_.changes(); }
    /// A lost prop stays where it was; at first it still counts as known, then `prop_known` is false. The eye
    /// of a lost head glides to one that is seen, or else to the default eye, and from there to a head that is found. Time does not go
    /// back from call to call.
    [[nodiscard]] Situation at(MonotonicTime lit);

private:
    enum class EyeOf { Default, Sensor, SeenHead };
    [[nodiscard]] glm::dvec3 middle_of_prop() const;
    /// Sets what is known of the eye.
    void look_for_eye(Situation& situation);
    /// What is lost after which time, and how far off each may be.
    [[nodiscard]] SourcePose by_tracker(MonotonicTime lit) const;
    [[nodiscard]] SourcePose by_tags(MonotonicTime lit) const;

    glm::dvec3 default_eye_m_;
    PoseEstimator prop_;
    PoseEstimator tags_;
    PoseEstimator head_;
    PoseEstimator visitor_;     ///< the holder's head, as it is seen
    double visitor_sd_m_ = 0.0; ///< that its latest sighting says
    Holder holder_;
    double lever_m_;
    TrackerHealth health_ = TrackerHealth::Well;
    double tags_sd_m_ = 0.0; ///< that the latest of their poses says
    HandOver hand_over_;
    ShownPose shown_prop_;
    RigidTransform prop_is_at_; ///< in the latest situation
    ShownPose shown_head_;
    EyeOf eye_of_ = EyeOf::Default;
    std::uint64_t eye_goals_ = 1; ///< how many until now; the default eye is the first
};

/// The time from `now`, at which a frame begins, until its picture is lit: the display's own latency plus a
/// slow average of the measured time from the beginning of a frame to its flip, which follows by the exact
/// solution over the time between two flips: a display of 30 Hz and one of 120 Hz end at the same.
class LightDelay {
public:
    static constexpr double time_constant_s = 0.16;

    explicit LightDelay(Nanoseconds display_latency) : display_latency_(display_latency) {}

    /// A frame that began at `now` was flipped at `flipped`. The time between is clamped to 0 to 100 ms; the first counts in full.
    /// A `now` that goes back changes nothing.
    void flipped(MonotonicTime now, MonotonicTime flipped);
    [[nodiscard]] Nanoseconds from_now() const;

private:
    Nanoseconds display_latency_;
    double flip_s_ = 0.0;
    std::optional<MonotonicTime> last_; ///< frame
};

} // namespace frustumscreen
