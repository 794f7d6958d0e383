/// Computes how much a few more unknowns, which disturb some touches alike, would improve a fit to touches.
///
/// Method   Linear about the fit. Of each unknown's column only the part counts that the fit's own 19 unknowns cannot
///          explain.
/// Units    residuals whitened, so that a gain is a difference of chi squared.
/// Threads  pure; any.
#pragma once

#include "app/calibration/fit.h"

#include <span>
#include <vector>

namespace frustumscreen::calibration {

/// A fit to all touches, ready to try more unknowns.
struct FittedTouches {
    Fit fit;
    WhitenedTouches whitened;
    Covariance covariance; ///< of the fit's unknowns
};
[[nodiscard]] FittedTouches fitted(std::span<const Touch> touches, const FitSetup& setup,
                                   const TouchModel& start);

/// Derivatives of a touch's whitened residuals by the extra unknowns: 3 rows.
using ExtraColumns = Eigen::MatrixXd;

struct Gain {
    double chi2 = 0.0;      ///< decrease of chi squared, at least 0
    Eigen::VectorXd values; ///< the unknowns that reach it
};
/// `columns`: one per touch, all of the same width.
[[nodiscard]] Gain gain_by(const FittedTouches& fitted, std::span<const ExtraColumns> columns);

/// A disturbance of the touches, estimated by a fit that includes it.
struct Disturbance {
    double chi2 = 0.0;     ///< of all touches, without the disturbance
    int freedom = 0;       ///< degrees of freedom left
    int unknowns = 0;      ///< of the disturbance, its place among the touches included
    double size_m = 0.0;   ///< largest displacement of a touch
    std::size_t touch = 0; ///< the first that it disturbs, or the one that it disturbs most
};

} // namespace frustumscreen::calibration
