/// The source arbiter: chooses between two trackers of one prop, and changes from one to the other without a
/// jump of the picture.
///
/// Leads    the tracker with the smaller expected error, by the spreads of both. It keeps the lead until the
///          other one has been better by the factor `clearly` for `dwell`, so two similar trackers do not
///          alternate. A lost tracker passes the lead on at once, if the other one is there.
/// Glide    at a change of lead the shown pose stays: the difference of the two poses at that moment is kept,
///          and fades along a smooth step. Its rate is at most `fastest_m_s`, measured at the prop, unless
///          that takes more than `longest`.
/// Jump     if the shown pose is stale, there is nothing to blend from: that is a reinitialisation, and
///          ShownPose glides.
/// Frames   table T, metres.
/// Time     of the pictures. The result depends on the times of the samples and not on the number of
///          pictures, except for the picture that notices a change of lead. A decreasing time changes no
///          lead.
/// Threads  one caller. Allocates nothing.
#pragma once

#include "app/tracking/pose_estimator.h"
#include "app/tracking/pose_math.h"

#include <array>
#include <optional>

namespace frustumscreen::tracking {

enum class Source : std::size_t { Tracker, Tags };

/// The pose of one source at the requested time.
struct SourcePose {
    PoseEstimate estimate;
    double sd_m = 0.0;         ///< expected error at the prop, standard deviation
    Nanoseconds lost_after{0}; ///< an older pose is not a measurement any more
};

struct SourceArbiterOptions {
    double clearly = 1.5; ///< ratio of the spreads
    Nanoseconds dwell = std::chrono::milliseconds(500);
    double fastest_m_s = 0.02;
    Nanoseconds shortest = std::chrono::milliseconds(250);
    Nanoseconds longest = std::chrono::milliseconds(1000);
    double lever_m = 0.06; ///< half the prop's height
};

class SourceArbiter {
public:
    explicit SourceArbiter(const SourceArbiterOptions& options = {}) : options_(options) {}

    /// The prop's pose at `time`: the leader's, plus the rest of the difference. While only one of the two
    /// sources was ever seen, it is that one's pose, bit for bit.
    [[nodiscard]] PoseEstimate follow(const SourcePose& tracker, const SourcePose& tags, MonotonicTime time);
    [[nodiscard]] Source leader() const { return leader_; }
    [[nodiscard]] std::uint64_t changes() const { return changes_; }

private:
    [[nodiscard]] bool gives_way(const SourcePose& leading, const SourcePose& other, MonotonicTime time);
    void change(const PoseEstimate& leading, const PoseEstimate& other, MonotonicTime time);
    [[nodiscard]] geometry::RigidTransform shown(const PoseEstimate& leading, MonotonicTime time) const;

    SourceArbiterOptions options_;
    Source leader_ = Source::Tracker;
    std::optional<MonotonicTime> better_since_; ///< the other source
    PoseStep left_;                             ///< from the leader's pose to the shown one, at the change
    MonotonicTime changed_;
    double fades_s_ = 0.0; ///< 0: no difference is left
    std::uint64_t changes_ = 0;
    std::uint64_t seen_ = 0;              ///< the leader's count of reinitialisations, at the latest picture
    std::uint64_t reinitialisations_ = 0; ///< of the shown pose
};

} // namespace frustumscreen::tracking
