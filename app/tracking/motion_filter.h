/// The exhibit's pose filter: one MotionTrack for the position and one for the rotation.
///
/// Models   rest, creep (position only), glide and manoeuvre; the defaults were tuned with
///          frustumscreen-bench latency and match its noise. With the single model Glide it is the
///          constant-velocity Kalman filter.
/// Threads  one caller. Allocates nothing.
/// Source   motion_track.h; the rotation is the error state of Sola, Quaternion kinematics for the
///          error-state Kalman filter, 2017, 5, with its angular velocity in the table's axes.
#pragma once

#include "app/tracking/motion_track.h"
#include "app/tracking/pose_filter.h"
#include "app/tracking/pose_noise.h"

namespace frustumscreen::tracking {

/// How long a motion goes on beyond the latest pose: its velocity and its acceleration decay with these time constants.
/// 0 = no decay.
struct Coasting {
    double velocity_s = 0.0;
    double acceleration_s = 0.0;
};

struct MotionFilterOptions {
    MotionTrackOptions place; ///< metres
    MotionTrackOptions turn;  ///< radians
    /// While it manoeuvres, the motion decays with this time constant, because a hand that changes its
    /// direction may stop. 0 = no decay.
    double manoeuvre_lasts_s = 0.0;
    Coasting place_coasts{};
    Coasting turn_coasts{};
};

/// For a prop that stands or slides on the table.
[[nodiscard]] MotionFilterOptions exhibit_filter(const PoseNoise& noise = {});
/// For a prop in a hand, which hardly ever rests: a calm and a vigorous manoeuvre, and no model of rest. Tuned on
/// recordings of hands at 1, 2 and 4 times their speed (docs/bench.md).
[[nodiscard]] MotionFilterOptions hand_filter(const PoseNoise& noise = {});
[[nodiscard]] MotionFilterOptions constant_velocity_filter(const PoseNoise& noise = {});

class MotionFilter final : public PoseFilter {
public:
    explicit MotionFilter(const MotionFilterOptions& options);

    void restart(const geometry::RigidTransform& measured) override;
    void take(const geometry::RigidTransform& measured, double dt_s) override;
    [[nodiscard]] geometry::RigidTransform ahead(double ahead_s) const override;
    [[nodiscard]] PoseSpread spread(double ahead_s) const override {
        return {place_.place_sd(ahead_s), turn_.place_sd(ahead_s)};
    }

private:
    MotionTrack place_;
    MotionTrack turn_;
    double manoeuvre_lasts_s_;
    Coasting place_coasts_;
    Coasting turn_coasts_;
    geometry::RigidTransform pose_; ///< reference of both tracks
};

} // namespace frustumscreen::tracking
