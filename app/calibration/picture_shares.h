/// How far the light lies beside its place, said as shares: within what at 68 and at 95 of 100 places, and within what everywhere.
///
/// Method   a thousand draws of what the fit leaves uncertain, and how far the light of every place of the zone moves with each. The same draws
///          every time.
/// Units    metres.
/// Time     ten milliseconds.
/// Threads  pure; any.
#pragma once

#include "app/calibration/zone.h"

#include <span>

namespace frustumscreen {

/// `covariance`: of the unknowns, positive definite.
[[nodiscard]] PictureShares picture_shares(std::span<const ZonePlace> places, const Covariance& covariance);

/// Of places that move linearly with errors of one standard deviation each: two rows for a place. `freedom`: from how many residuals that
/// standard deviation was estimated; 0: it is known.
[[nodiscard]] PictureShares picture_shares(const Eigen::MatrixXd& moves_by_error, int freedom);

} // namespace frustumscreen
