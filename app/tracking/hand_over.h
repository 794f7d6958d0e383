/// Two trackers of one prop, of which one leads: who, and how the picture goes over from one to the other without a jump.
///
/// Leads    the tracker whose pose is less likely to be wrong, by the spreads that both say. It keeps the lead until the other one has
///          been better by `clearly` for `dwell`, so that two that are alike do not take turns. One that is lost gives the lead
///          away at once, if the other is there.
/// Glide    at a change of lead the pose stays where it was: the difference of the two at that moment is kept, and fades along a
///          smooth step. Its rate is at most `fastest_m_s`, measured at the prop, or what brings it in within `longest`.
/// Jump     where the pose that was shown is stale there is nothing to go over from: that is a reinitialisation, and ShownPose glides.
/// Frames   table T, metres.
/// Time     of the pictures: the result at a time depends on the times of what came before and not on how many pictures there were,
///          but for the picture at which a change of lead is seen. Time that goes back changes no lead.
/// Threads  one caller. Allocates nothing.
#pragma once

#include "app/tracking/pose_estimator.h"
#include "app/tracking/pose_math.h"

#include <array>
#include <optional>

namespace frustumscreen {

enum class Source : std::size_t { Tracker, Tags };

/// What one of the two says of the time that is asked for.
struct SourcePose {
    PoseEstimate estimate;
    double sd_m = 0.0;         ///< how far it may be off, at the prop, standard deviation
    Nanoseconds lost_after{0}; ///< an older pose is no measurement any more
};

struct HandOverOptions {
    double clearly = 1.5; ///< times less spread
    Nanoseconds dwell = std::chrono::milliseconds(500);
    double fastest_m_s = 0.02;
    Nanoseconds shortest = std::chrono::milliseconds(250);
    Nanoseconds longest = std::chrono::milliseconds(1000);
    double lever_m = 0.06; ///< half the prop's height
};

class HandOver {
public:
    explicit HandOver(const HandOverOptions& options = {}) : options_(options) {}

    /// The prop's pose at `time`: the leader's, with what is left of the difference. While only one of the two was ever
    /// seen it is that one's, bit for bit.
    [[nodiscard]] PoseEstimate follow(const SourcePose& tracker, const SourcePose& tags, MonotonicTime time);
    [[nodiscard]] Source leader() const { return leader_; }
    [[nodiscard]] std::uint64_t changes() const { return changes_; }

private:
    [[nodiscard]] bool gives_way(const SourcePose& leading, const SourcePose& other, MonotonicTime time);
    void change(const PoseEstimate& leading, const PoseEstimate& other, MonotonicTime time);
    [[nodiscard]] RigidTransform shown(const PoseEstimate& leading, MonotonicTime time) const;

    HandOverOptions options_;
    Source leader_ = Source::Tracker;
    std::optional<MonotonicTime> better_since_; ///< the other one
    PoseStep left_;                             ///< from the leader's pose to the one shown, at the change
    MonotonicTime changed_;
    double fades_s_ = 0.0; ///< 0: nothing is left
    std::uint64_t changes_ = 0;
    std::uint64_t seen_ = 0;              ///< the leader's count of reinitialisations, at the latest picture
    std::uint64_t reinitialisations_ = 0; ///< of what is shown
};

} // namespace frustumscreen
