/// The pose of one station at any time, from a tracker's samples: outliers removed, smoothed, predicted.
///
/// Frames   those of the samples; metres, unit quaternions.
/// Time     CLOCK_MONOTONIC. Normally asked for the time at which the picture is lit. Samples take effect at
///          their own time; late and repeated ones have no effect, whatever the intervals of the others.
/// Errors   none: an invalid pose is refused; without any pose the answer is stale.
/// Threads  one caller. Allocates nothing after construction.
#pragma once

#include "app/tracking/pose_filter.h"
#include "firmware_host/tracker/tracker.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>

namespace frustumscreen::tracking {

enum class PoseStatus {
    Exact,        ///< a sample of exactly that time, smoothed
    Interpolated, ///< between two samples
    Predicted,    ///< after the latest sample
    Stale,        ///< too long after the latest sample, or before the history: the nearest pose
};

struct PoseEstimate {
    geometry::RigidTransform pose;
    PoseStatus status = PoseStatus::Stale;
    Nanoseconds age{0}; ///< from the latest sample to the requested time
    /// Number of restarts and of gaps in the samples, each perhaps with a jump; 0 = no pose was ever seen.
    std::uint64_t reinitialisations = 0;
};

enum class Taken {
    Used,
    Late,    ///< not after the latest sample
    Outlier, ///< faster than a hand can move
    NoPose,  ///< not finite, or a quaternion of zero
};

struct PoseEstimatorOptions {
    bool predicts = true; ///< false: the latest smoothed pose at any time; for comparison
    /// The motion is predicted in full for this long after the latest sample; then it comes to rest.
    Nanoseconds predicted_for = std::chrono::milliseconds(80);
    Nanoseconds stand_within = std::chrono::milliseconds(30); ///< time constant
    /// A pose becomes stale after this time; with a slow tracker after two and a half of its intervals, but
    /// at most `stale_at_last`.
    Nanoseconds stale_after = std::chrono::milliseconds(1000);
    Nanoseconds stale_at_last = std::chrono::seconds(5);
    /// A sample after a gap of at least this, and of two and a half usual intervals, may lie beside what was predicted.
    Nanoseconds gap_from = std::chrono::milliseconds(50);
    Nanoseconds forgotten_after = std::chrono::milliseconds(250); ///< a longer gap restarts the filter
    /// After a restart the motion is not known yet: the prediction grows to its full length along a smooth step, so that
    /// it does not jump ahead when the first samples tell of a motion.
    Nanoseconds learns_within = std::chrono::milliseconds(200);
    /// Allowed distance of a sample from its prediction: the effect of a knock.
    double surprise_m = 0.015;
    double surprise_rad = 0.15;
    double speed_m_s = 2.0; ///< added per second since the latest sample
    double turn_rad_s = 15.0;
    /// This many consecutive outliers that agree with each other show where the prop is now; this many
    /// consecutive late samples show that the device's clock was set back.
    int convinced_by = 3;
    int clock_set_back_by = 16;
};

class PoseEstimator {
public:
    static constexpr std::size_t remembered = 128; ///< samples

    explicit PoseEstimator(std::unique_ptr<PoseFilter> filter, const PoseEstimatorOptions& options = {});

    /// The caller selects the station and must have checked `ok`.
    Taken take(MonotonicTime time, const geometry::RigidTransform& measured);
    /// The next pose restarts the filter: it belongs to another object.
    void forget() { count_ = 0; }
    [[nodiscard]] PoseEstimate at(MonotonicTime time) const;
    /// Spread of the estimate `at(time)`, from the filter; before the latest sample, that of the latest
    /// sample.
    [[nodiscard]] PoseSpread spread(MonotonicTime time) const;

private:
    struct Moment {
        MonotonicTime time;
        geometry::RigidTransform pose;
    };

    [[nodiscard]] const Moment& moment(std::size_t back) const; ///< 0 = the latest
    void remember(const Moment& moment);
    /// The shorter of the latest two.
    [[nodiscard]] Nanoseconds usual_interval() const { return std::min(steps_[0], steps_[1]); }
    [[nodiscard]] Nanoseconds stale_after() const;
    Taken take_up(const Moment& measured);
    [[nodiscard]] bool plausible(const geometry::RigidTransform& expected,
                                 const geometry::RigidTransform& measured, double dt_s) const;
    Taken doubt(const Moment& measured);
    [[nodiscard]] geometry::RigidTransform predicted(double age_s) const;
    /// `time` is not after the latest sample.
    [[nodiscard]] std::pair<geometry::RigidTransform, PoseStatus> remembered_at(MonotonicTime time) const;

    std::unique_ptr<PoseFilter> filter_;
    PoseEstimatorOptions options_;
    std::array<Moment, remembered> history_{};
    std::size_t count_ = 0;
    std::size_t next_ = 0;
    /// Intervals of the latest samples; a single gap does not make a tracker slow.
    std::array<Nanoseconds, 2> steps_{};
    Moment doubtful_;         ///< the latest outlier
    MonotonicTime restarted_; ///< time of the sample that restarted the filter
    int outliers_ = 0;
    int late_ = 0;
    std::uint64_t reinitialisations_ = 0;
};

} // namespace frustumscreen::tracking
