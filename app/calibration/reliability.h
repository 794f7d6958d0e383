/// Tests whether a touch agrees with the others' prediction, and bounds the error of one wrong touch or rest
/// that goes unnoticed.
/// Units    metres; residuals whitened, so that chi squared is what it should be.
/// Threads  pure; any.
/// Source   Baarda, A testing procedure for use in geodetic networks, 1968: data snooping, external reliability
#pragma once

#include "app/calibration/fit.h"
#include "app/calibration/zone.h"

#include <cmath>

namespace frustumscreen::calibration {

/// Limit of the three residuals of a touch: one right touch in a thousand exceeds it.
inline constexpr double touch_chi2_limit = 16.0;

/// Leave-one-out chi squared of a touch's residuals.
[[nodiscard]] double left_out_chi2(const TouchRows& rows, const Eigen::Vector3d& residual,
                                   const Covariance& covariance);

/// An error that a fit may absorb unnoticed: the unknowns' derivatives by it, and its covariance at the limit
/// of detection, for a chi squared limit of 1.
template <int errors> struct UnseenError {
    Eigen::Matrix<double, unknown_count, errors> moves;
    Eigen::Matrix<double, errors, errors> spread;
};

/// The larger eigenvalue.
[[nodiscard]] double largest(const Eigen::Matrix2d& symmetric);

/// The largest move of the picture by one wrong report that goes unnoticed, over all reports and places of
/// the zone.
template <int errors>
double hidden_error_m(std::span<const UnseenError<errors>> unseen, double chi2_limit,
                      std::span<const ZonePlace> places) {
    double worst2 = 0.0;
    for (const UnseenError<errors>& error : unseen) {
        for (const ZonePlace& place : places) {
            const Eigen::Matrix<double, 2, errors> by_error = place.rows * error.moves;
            worst2 = std::fmax(worst2, largest(by_error * error.spread * by_error.transpose()));
        }
    }
    return std::sqrt(chi2_limit * worst2);
}

/// The same for one wrong touch.
[[nodiscard]] double hidden_error_m(std::span<const TouchRows> touches, const Covariance& covariance,
                                    std::span<const ZonePlace> places);

} // namespace frustumscreen::calibration
