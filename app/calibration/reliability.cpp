#include "app/calibration/reliability.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

/// Covariance of a touch's whitened residuals: the noise less the touch's own part in the fit.
Eigen::Matrix3d left_of(const TouchRows& rows, const Covariance& covariance) {
    return Eigen::Matrix3d::Identity() - rows * covariance * rows.transpose();
}

} // namespace

double largest(const Eigen::Matrix2d& symmetric) {
    const double half = 0.5 * symmetric.trace();
    return half + std::sqrt(std::fmax(0.0, half * half - symmetric.determinant()));
}

double left_out_chi2(const TouchRows& rows, const Eigen::Vector3d& residual, const Covariance& covariance) {
    return residual.dot(left_of(rows, covariance).ldlt().solve(residual));
}

double hidden_error_m(std::span<const TouchRows> touches, const Covariance& covariance,
                      std::span<const ZonePlace> places) {
    std::vector<UnseenError<3>> unseen;
    for (const TouchRows& rows : touches) {
        // Among all errors b with b' left b = limit, the one that moves the picture most: the ellipse's
        // image.
        unseen.push_back({covariance * rows.transpose(), left_of(rows, covariance).inverse()});
    }
    return hidden_error_m(std::span<const UnseenError<3>>(unseen), touch_chi2_limit, places);
}

} // namespace frustumscreen::calibration
