/// Whether a touch is as the others predict it, and what a wrong one could do that is not noticed.
///
/// Units    metres; residuals whitened, so that chi squared is what it should be.
/// Threads  pure; any.
/// Source   Baarda, A testing procedure for use in geodetic networks, 1968: data snooping, external reliability
#pragma once

#include "app/calibration/fit.h"
#include "app/calibration/zone.h"

namespace frustumscreen {

/// Of three residuals of a touch that is right, one in a thousand is beyond.
inline constexpr double touch_chi2_limit = 16.0;

/// Chi squared of a touch's residuals as the others predict them.
[[nodiscard]] double left_out_chi2(const TouchRows& rows, const Eigen::Vector3d& residual,
                                   const Covariance& covariance);

/// How far one wrong touch could move the picture and yet agree, at the worst touch and place of the zone.
[[nodiscard]] double hidden_error_m(std::span<const TouchRows> touches, const Covariance& covariance,
                                    std::span<const ZonePlace> places);

} // namespace frustumscreen
