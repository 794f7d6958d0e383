#include "app/calibration/procedure/still_reports.h"

#include "app/geometry/rotation_angle.h"

#include <cassert>

namespace frustumscreen::calibration {

bool is_near(const geometry::RigidTransform& a, const geometry::RigidTransform& b, double distance_m,
             double angle_rad) {
    return glm::distance(a.translation, b.translation) <= distance_m &&
           geometry::rotation_angle(a.rotation, b.rotation) <= angle_rad;
}

bool StillReports::add(MonotonicTime now, const geometry::RigidTransform& report) {
    const bool is_near_first = count_ == 0 || is_near(report, first_, limits_.move_m, limits_.turn_rad);
    if (!is_near_first && ++elsewhere_ < strays_) {
        return true;
    }
    if (!is_near_first) {
        clear();
    }
    elsewhere_ = 0;
    if (count_ == 0) {
        began_ = now;
        first_ = report;
    }
    ++count_;
    last_ = now;
    places_ += report.translation;
    turns_ += glm::dot(report.rotation, first_.rotation) < 0.0 ? -report.rotation : report.rotation;
    return is_near_first;
}

/// For similar poses, the sum of same-signed quaternions is their mean to second order.
geometry::RigidTransform StillReports::mean() const {
    assert(count_ > 0);
    return {glm::normalize(turns_), places_ / static_cast<double>(count_)};
}

} // namespace frustumscreen::calibration
