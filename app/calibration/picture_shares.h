/// The light's error on the table as shares: the distance that holds at 68 and at 95 of 100 places, and at
/// the worst place.
///
/// Method   A thousand seeded draws from the fit's covariance; each moves the light of every place of the
///          zone.
/// Units    metres.
/// Time     ten milliseconds.
/// Threads  pure; any.
#pragma once

#include "app/calibration/zone.h"

#include <span>

namespace frustumscreen::calibration {

/// `covariance`: of the unknowns, positive definite.
[[nodiscard]] PictureShares picture_shares(std::span<const ZonePlace> places, const Covariance& covariance);

/// `moves_by_error`: two rows a place, its linear move by each error of one standard deviation. `freedom`: the number
/// of residuals that the standard deviation was estimated from; 0: it is known.
[[nodiscard]] PictureShares picture_shares(const Eigen::MatrixXd& moves_by_error, int freedom);

} // namespace frustumscreen::calibration
