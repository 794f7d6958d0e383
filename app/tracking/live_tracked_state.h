/// The tracked state, prop pose and eye, at the time at which the picture is lit: from a live tracker's
/// samples, smoothed and predicted. An offline picture uses TrackedStateTracker, which does neither.
///
/// Tags     an optional second tracker of the prop. Each of the two has its own estimator; the source arbiter
///          (source_arbiter.h) chooses between them.
/// Visitor  heads that a camera sees, without a marker on them. While no sensor reports the visitor's head, the eye
///          is that of the active visitor (active_visitor.h); it glides from one person to another.
/// Stereo   two eyes, turned as the sensor on the head; a head that a camera sees, and a fixed viewer, look level at
///          the prop. For glasses that lie (worn_glasses.h), and for a head that is lost, the picture changes
///          smoothly to one eye (eyes_apart.h).
/// Torches  where the settings have them: each with an estimator of its own (torch_follower.h).
/// Frames   table T, metres; samples too (registered_tracker.h).
/// Time     a sample takes effect at its own time; `at(lit)` asks for the time at which the picture is lit.
/// Threads  values; one caller. Allocates nothing after construction.
#pragma once

#include "app/tracking/active_visitor.h"
#include "app/tracking/eyes_apart.h"
#include "app/tracking/pose_estimator.h"
#include "app/tracking/shown_pose.h"
#include "app/tracking/source_arbiter.h"
#include "app/tracking/torch_follower.h"
#include "app/tracking/tracked_state.h"
#include "app/tracking/uncertain_pose.h"
#include "app/tracking/worn_glasses.h"

#include <array>
#include <cstdint>
#include <optional>

namespace frustumscreen::tracking {

/// The visitor's two eyes, as stereo follows them.
struct TwoEyes {
    double half_apart_m = 0.0;   ///< half of the interocular distance; 0: one eye, and no turn is followed
    bool fixed_viewer = false;   ///< no head is followed: both eyes are beside the default eye
    bool glasses_may_lie = true; ///< false: a simulated visitor never takes them off
};

/// How the prop moves. One that stands on the table at all times is followed by the table's filter alone.
enum class PropMotion : std::uint8_t { OnTable, InHand };

class LiveTrackedState {
public:
    /// `lever_m`: half the prop's height.
    LiveTrackedState(const glm::dvec3& default_eye_m, double lever_m, const TwoEyes& two_eyes = {},
                     PropMotion motion = PropMotion::InHand, const TorchSources& torches = {});

    /// Returns false for a sample that claims to be usable but is not a pose, or moves as no hand can.
    bool take(const tracker::PoseSample& sample);
    /// As `take`, for a pose from the tags.
    bool take_tags(const UncertainPose& pose);
    /// As `take_tags`, for a lamp's tag: `table_from_prop` is the torch's pose.
    bool take_lamp(const UncertainPose& pose);
    /// Takes a head; heads come in ascending time. Returns false if its position is invalid.
    bool take_visitor(const SeenHead& head);
    /// Sets the tracker's health; metal near the tracker increases the spread of its poses.
    void tracker_is(tracker::TrackerHealth health) { health_ = health; }
    /// Number of changes between tracker and tags.
    [[nodiscard]] std::uint64_t source_changes() const { return source_arbiter_.changes(); }
    /// The tracked state at `lit`. A lost prop stays where it was; `prop_known` becomes false after a while.
    /// The eye of a lost head glides to a seen head, otherwise to the default eye, and from there to a head
    /// that is found. `lit` must not decrease from call to call.
    [[nodiscard]] TrackedState at(MonotonicTime lit);

private:
    enum class EyeOf { Default, Sensor, SeenHead };
    [[nodiscard]] glm::dvec3 middle_of_prop() const;
    /// Sets the eye of `tracked_state`.
    void look_for_eye(TrackedState& tracked_state);
    /// Sets the turn of the head and how far apart the eyes are. `goal`: of the eye.
    void look_for_turn(const PoseEstimate& head, const PoseEstimate& goal, TrackedState& tracked_state);
    /// The pose of each source, with its spread and the age at which it is lost.
    [[nodiscard]] SourcePose by_tracker(MonotonicTime lit) const;
    [[nodiscard]] SourcePose by_tags(MonotonicTime lit) const;

    glm::dvec3 default_eye_m_;
    PoseEstimator prop_;
    PoseEstimator tags_;
    PoseEstimator head_;
    PoseEstimator visitor_;     ///< the active visitor's head, as seen by a camera
    double visitor_sd_m_ = 0.0; ///< from its latest sighting
    ActiveVisitor active_visitor_;
    double lever_m_;
    tracker::TrackerHealth health_ = tracker::TrackerHealth::Well;
    double tags_sd_m_ = 0.0; ///< from the latest pose of the tags
    SourceArbiter source_arbiter_;
    ShownPose shown_prop_;
    geometry::RigidTransform prop_is_at_; ///< in the latest tracked state
    ShownPose shown_head_;
    EyeOf eye_of_ = EyeOf::Default;
    std::uint64_t eye_goals_ = 1; ///< number of goals so far; the default eye is the first
    TwoEyes two_eyes_;
    ShownPose shown_turn_; ///< of the head; at the table's origin
    WornGlasses
        glasses_; ///< by the sensor's own poses: a prediction for a slow picture would add to their noise
    bool glasses_worn_ = true;
    EyesApart eyes_apart_;
    std::array<std::optional<TorchFollower>, max_tracked_torches> torches_; ///< as TrackedState::torches
};

/// Estimates the time from `now`, the start of a frame, until its picture is lit: the display's own latency
/// plus a slow average of the measured time from the start of a frame to its flip. The average uses the exact
/// solution over the time between two flips, so displays of 30 Hz and of 120 Hz converge equally.
class LightDelay {
public:
    static constexpr double time_constant_s = 0.16;

    explicit LightDelay(Nanoseconds display_latency) : display_latency_(display_latency) {}

    /// A frame that began at `now` was flipped at `flipped`. The time between is clamped to 0 to 100 ms; the
    /// first one counts in full. A decreasing `now` has no effect.
    void flipped(MonotonicTime now, MonotonicTime flipped);
    [[nodiscard]] Nanoseconds from_now() const;

private:
    Nanoseconds display_latency_;
    double flip_s_ = 0.0;
    std::optional<MonotonicTime> last_; ///< start of the last frame
};

} // namespace frustumscreen::tracking
