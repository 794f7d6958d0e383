/// The pose of one station at any time, from a tracker's samples: without outliers, smoothed, predicted.
///
/// Frames   those of the samples; metres, unit quaternions.
/// Time     CLOCK_MONOTONIC. Normally asked for the time at which the picture is lit. Samples count from
///          their own time; late and repeated ones change nothing, whatever the steps between the others.
/// Errors   none: what is no pose is refused; without any pose the answer is stale.
/// Threads  one caller. Allocates nothing after construction.
#pragma once

#include "app/tracking/pose_filter.h"
#include "firmware_host/tracker/tracker.h"

#include <array>
#include <cstdint>
#include <memory>
#include <utility>

namespace frustumscreen {

enum class PoseStatus {
    Exact,        ///< a sample of just that time, smoothed
    Interpolated, ///< between two samples
    Predicted,    ///< after the latest sample
    Stale,        ///< too long after it, or before anything that is remembered: the nearest pose
};

struct PoseEstimate {
    RigidTransform pose;
    PoseStatus status = PoseStatus::Stale;
    Nanoseconds age{0}; ///< from the latest sample to the time asked for
    /// How often the pose began anew, perhaps with a jump; 0 = it was never seen.
    std::uint64_t reinitialisations = 0;
};

enum class Taken {
    Used,
    Late,    ///< not after the latest
    Outlier, ///< no hand moves like that
    NoPose,  ///< not finite, or a quaternion of zero
};

struct PoseEstimatorOptions {
    bool predicts = true; ///< false: the latest smoothed pose, whatever time is asked for; for comparison
    /// Predicted in full for this long after the latest sample; then the motion comes to rest.
    Nanoseconds predicted_for = std::chrono::milliseconds(80);
    Nanoseconds stand_within = std::chrono::milliseconds(30); ///< time constant
    /// Held until then; of a slow tracker for two and a half of its steps, to `stale_at_last`.
    Nanoseconds stale_after = std::chrono::milliseconds(1000);
    Nanoseconds stale_at_last = std::chrono::seconds(5);
    Nanoseconds forgotten_after = std::chrono::milliseconds(250); ///< after a longer gap it begins anew
    /// Allowed distance from where the sample was expected: what a knock may do.
    double surprise_m = 0.015;
    double surprise_rad = 0.15;
    double speed_m_s = 2.0; ///< and this much more for each second since the latest sample
    double turn_rad_s = 15.0;
    /// This many outliers in a row that agree with each other show where the prop is now; this many late
    /// samples in a row show that the device's clock was set back.
    int convinced_by = 3;
    int clock_set_back_by = 16;
};

class PoseEstimator {
public:
    static constexpr std::size_t remembered = 128; ///< samples

    explicit PoseEstimator(std::unique_ptr<PoseFilter> filter, const PoseEstimatorOptions& options = {});

    /// The caller chooses the station and must have checked `ok`.
    Taken take(MonotonicTime time, const RigidTransform& measured);
    /// The next pose begins anew: it is of something else.
    void forget() { count_ = 0; }
    [[nodiscard]] PoseEstimate at(MonotonicTime time) const;
    /// Of that estimate, as far as the filter knows it; of a time before the latest sample as of that sample.
    [[nodiscard]] PoseSpread spread(MonotonicTime time) const;

private:
    struct Moment {
        MonotonicTime time;
        RigidTransform pose;
    };

    [[nodiscard]] const Moment& moment(std::size_t back) const; ///< 0 = the latest
    void remember(const Moment& moment);
    [[nodiscard]] Nanoseconds stale_after() const;
    Taken take_up(const Moment& measured);
    [[nodiscard]] bool plausible(const RigidTransform& expected, const RigidTransform& measured,
                                 double dt_s) const;
    Taken doubt(const Moment& measured);
    [[nodiscard]] RigidTransform predicted(double age_s) const;
    /// `time` is not after the latest.
    [[nodiscard]] std::pair<RigidTransform, PoseStatus> remembered_at(MonotonicTime time) const;

    std::unique_ptr<PoseFilter> filter_;
    PoseEstimatorOptions options_;
    std::array<Moment, remembered> history_{};
    std::size_t count_ = 0;
    std::size_t next_ = 0;
    /// Between the latest samples; one gap alone does not make a slow tracker.
    std::array<Nanoseconds, 2> steps_{};
    Moment doubtful_; ///< the latest outlier
    int outliers_ = 0;
    int late_ = 0;
    std::uint64_t reinitialisations_ = 0;
};

} // namespace frustumscreen
