/// The 1 Euro filter and a pass-through filter, as references for the exhibit's filter.
///
/// Frames   pose_filter.h.
/// Threads  one caller. Allocates nothing.
/// Source   Casiez, Roussel and Vogel, 1 Euro filter: a simple speed-based low-pass filter for noisy input in
///          interactive systems, 2012, algorithm 1; rotations enter as rotation vectors from the previous
///          pose. `ahead` is not in the paper: it extrapolates with the filtered derivative.
#pragma once

#include "app/tracking/pose_filter.h"
#include "app/tracking/pose_math.h"

namespace frustumscreen::bench {

struct OneEuroOptions {
    double min_cutoff_hz = 1.0;
    double place_beta_per_m = 200.0; ///< cut-off per m/s
    double turn_beta_per_rad = 20.0; ///< cut-off per rad/s
    double derivative_cutoff_hz = 8.0;
};

class OneEuroFilter final : public tracking::PoseFilter {
public:
    explicit OneEuroFilter(const OneEuroOptions& options = {}) : options_(options) {}

    void restart(const geometry::RigidTransform& measured) override;
    void take(const geometry::RigidTransform& measured, double dt_s) override;
    [[nodiscard]] geometry::RigidTransform ahead(double ahead_s) const override;

private:
    OneEuroOptions options_;
    geometry::RigidTransform measured_;
    geometry::RigidTransform pose_;
    tracking::PoseStep rate_; ///< per second
};

/// Returns the latest pose unchanged.
class NoFilter final : public tracking::PoseFilter {
public:
    void restart(const geometry::RigidTransform& measured) override { pose_ = measured; }
    void take(const geometry::RigidTransform& measured, double /*dt_s*/) override { pose_ = measured; }
    [[nodiscard]] geometry::RigidTransform ahead(double /*ahead_s*/) const override { return pose_; }

private:
    geometry::RigidTransform pose_;
};

} // namespace frustumscreen::bench
