/// The torch's pose filter: the light of a pointing hand stands still although the hand trembles, and follows it when it
/// points elsewhere.
///
/// Method   a follower of the first order whose time constant falls with the distance to the measured pose, so that a
///          hand's tremor (4 to 12 Hz, tenths of a degree) is smoothed and a sweep is not. The rest of its lag is made
///          up by the motion, which counts only above the speed of a tremor. tests/tracking/steady_filter_test.cpp has
///          its scatter and its lag beside those of the prop's filter.
/// Differs  from Casiez, Roussel and Vogel, The 1 euro filter, 2012: the distance steers it, not the speed, which is
///          known later.
/// Frames   those of the given poses; metres, radians.
/// Threads  one caller. Allocates nothing.
#pragma once

#include "app/tracking/pose_filter.h"
#include "app/tracking/pose_math.h"

namespace frustumscreen::tracking {

/// One of position and rotation; `unit`: metres or radians.
struct SteadyOptions {
    double calm_s = 0.15;     ///< time constant at rest
    double tremor = 0.003;    ///< unit: at this distance the time constant has halved
    double moves_from = 0.05; ///< unit/s: below it the motion does not count
    double moves_at = 0.20;   ///< unit/s: from it on it counts in full
};
struct SteadyFilterOptions {
    SteadyOptions place;
    SteadyOptions turn{.calm_s = 0.15, .tremor = 0.014, .moves_from = 0.17, .moves_at = 0.52};
};
/// For a tag that a camera sees, whose poses scatter more.
[[nodiscard]] SteadyFilterOptions lamp_filter();

class SteadyFilter final : public PoseFilter {
public:
    explicit SteadyFilter(const SteadyFilterOptions& options = {}) : options_(options) {}

    void restart(const geometry::RigidTransform& measured) override;
    void take(const geometry::RigidTransform& measured, double dt_s) override;
    [[nodiscard]] geometry::RigidTransform ahead(double ahead_s) const override;

private:
    struct Motion {
        glm::dvec3 velocity{0.0};
        double lag_s = 0.0; ///< of the smoothed value, in a steady motion
    };
    /// Takes the step from the previous measurement; returns the share of `off` to follow.
    [[nodiscard]] static double follow(const SteadyOptions& options, const glm::dvec3& step,
                                       const glm::dvec3& off, double dt_s, Motion& motion);
    [[nodiscard]] static glm::dvec3 way(const SteadyOptions& options, const Motion& motion, double ahead_s);

    SteadyFilterOptions options_;
    geometry::RigidTransform measured_; ///< the latest
    geometry::RigidTransform pose_;     ///< smoothed
    Motion place_, turn_;
};

} // namespace frustumscreen::tracking
