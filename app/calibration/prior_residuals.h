/// Residuals of the priors, which hold for any projector and any boards, independent of the points.
///
/// Numbers  templates over T: double, or numbers that carry derivatives (ceres::Jet).
/// Threads  pure; any.
#pragma once

#include "app/calibration/priors.h"
#include "app/calibration/unknowns.h"

#include <cmath>
#include <span>

namespace frustumscreen::calibration {

inline constexpr int prior_count = 6;

/// Writes prior_count residuals in units of their standard deviations; `change`: unknown_count numbers.
template <typename T>
void prior_residuals(const Priors& priors, const TouchModel& model, const T* change, T* out) {
    const geometry::Pinhole& base = model.pinhole;
    const double width = base.width;
    out[0] = (change[aspect_log] + std::log(base.fx / base.fy)) / priors.aspect;
    out[1] = (change[centre_u] + (base.cx / width - 0.5)) / priors.centre_u;
    out[2] = (change[centre_v] + (base.cy - 0.5 * base.height) / width) / priors.centre_v;
    out[3] = (change[lens_k1] + base.lens.k1) / priors.k1;
    out[4] = (change[lens_k2] + base.lens.k2) / priors.k2;
    out[5] = (change[boards_share] + (model.boards - 1.0)) / priors.boards;
}

/// Mean height of the sensor above the touched place, over rotations of the sensor in K; at least one
/// rotation.
template <typename T>
T sensor_height(const ChangedModel<T>& model, std::span<const Eigen::Matrix3d> tracker_from_sensor) {
    T sum(0.0);
    for (const Eigen::Matrix3d& turn : tracker_from_sensor) {
        sum -= model.up.dot(turn.cast<T>() * model.offset);
    }
    return sum / static_cast<double>(tracker_from_sensor.size());
}

} // namespace frustumscreen::calibration
