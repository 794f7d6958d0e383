/// The exhibit's filter of a prop that may be lifted. A filter for the table and one for the hand run side by side,
/// and the pose is a mixture of both by how much the prop is held (held_meter.h).
///
/// Table    while nothing lifts or tilts the prop, its poses are those of the table's filter bit for bit: as still, and as
///          little beyond a stop.
/// Hand     the motion goes on: less slip, and more tremble.
/// Frames   pose_filter.h.
/// Threads  one caller. Allocates nothing after construction.
#pragma once

#include "app/tracking/held_meter.h"
#include "app/tracking/motion_filter.h"

namespace frustumscreen::tracking {

class HeldFilter final : public PoseFilter {
public:
    explicit HeldFilter(const PoseNoise& noise = {}, double lever_m = 0.06);

    void restart(const geometry::RigidTransform& measured) override;
    void take(const geometry::RigidTransform& measured, double dt_s) override;
    [[nodiscard]] geometry::RigidTransform ahead(double ahead_s) const override;
    [[nodiscard]] PoseSpread spread(double ahead_s) const override;
    /// 0: the table's filter; 1: the hand's.
    [[nodiscard]] double held() const { return meter_.share(); }

private:
    MotionFilter table_;
    MotionFilter hand_;
    HeldMeter meter_;
};

} // namespace frustumscreen::tracking
