/// Accumulates the tracker's reports of a resting prop or a still head: since when it rests, and its mean
/// pose.
///
/// Frames   tracker K, as the device reports.
/// Threads  one caller.
#pragma once

#include "app/geometry/transform.h"
#include "firmware_host/base/time.h"

#include <optional>

namespace frustumscreen::calibration {

/// Largest distance of a report from the first one of its rest.
struct StillLimits {
    double move_m = 1.5e-3;
    double turn_rad = 0.02;
};

class StillReports {
public:
    /// `strays`: the number of consecutive reports elsewhere that mean a move; fewer are ignored.
    explicit StillReports(int strays) : strays_(strays) {}
    StillReports(int strays, StillLimits limits) : strays_(strays), limits_(limits) {}

    /// False if it moved: a new rest begins with this report.
    bool add(MonotonicTime now, const geometry::RigidTransform& report);
    void clear() { *this = StillReports(strays_, limits_); }

    [[nodiscard]] std::size_t count() const { return count_; }
    /// Duration of the rest; zero before the first report.
    [[nodiscard]] Nanoseconds rest() const { return count_ > 0 ? last_ - began_ : Nanoseconds(0); }
    /// Mean pose of the rest's reports; at least one.
    [[nodiscard]] geometry::RigidTransform mean() const;

private:
    int strays_;
    StillLimits limits_;
    std::size_t count_ = 0;
    int elsewhere_ = 0; ///< stray reports in a row
    MonotonicTime began_{};
    MonotonicTime last_{};
    geometry::RigidTransform first_;
    glm::dvec3 places_{0.0}; ///< sums
    glm::dquat turns_{0.0, 0.0, 0.0, 0.0};
};

/// True if two poses differ by no more than these limits.
[[nodiscard]] bool is_near(const geometry::RigidTransform& a, const geometry::RigidTransform& b,
                           double distance_m, double angle_rad);

} // namespace frustumscreen::calibration
