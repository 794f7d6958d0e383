/// The tracker's reports of a prop that rests, or of a head that is held still: since when, and where on average.
///
/// Frames   tracker K, as the device reports.
/// Threads  one caller.
#pragma once

#include "app/geometry/transform.h"
#include "firmware_host/base/time.h"

#include <optional>

namespace frustumscreen {

/// How far a report may lie from the first one of its rest.
struct StillLimits {
    double move_m = 1.5e-3;
    double turn_rad = 0.02;
};

class StillReports {
public:
    /// `strays`: so many reports in a row lie elsewhere: it moved; fewer are left out.
    explicit StillReports(int strays) : strays_(strays) {}
    StillReports(int strays, StillLimits limits) : strays_(strays), limits_(limits) {}

    /// False: it moved, and a new rest begins with this report.
    bool add(MonotonicTime now, const RigidTransform& report);
    void clear() { *this = StillReports(strays_, limits_); }

    [[nodiscard]] std::size_t count() const { return count_; }
    /// How long it has rested; no report yet: zero.
    [[nodiscard]] Nanoseconds rest() const { return count_ > 0 ? last_ - began_ : Nanoseconds(0); }
    /// Of the rest's reports; there is one at least.
    [[nodiscard]] RigidTransform mean() const;

private:
    int strays_;
    StillLimits limits_;
    std::size_t count_ = 0;
    int elsewhere_ = 0; ///< reports in a row
    MonotonicTime began_{};
    MonotonicTime last_{};
    RigidTransform first_;
    glm::dvec3 places_{0.0}; ///< sums
    glm::dquat turns_{0.0, 0.0, 0.0, 0.0};
};

/// Whether two poses are as near as that.
[[nodiscard]] bool is_near(const RigidTransform& a, const RigidTransform& b, double distance_m,
                           double angle_rad);

} // namespace frustumscreen
