#include "app/calibration/reliability.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace frustumscreen {

namespace {

/// The covariance of a touch's residuals is what its own part in the fit leaves of the noise.
Eigen::Matrix3d left_of(const TouchRows& rows, const Covariance& covariance) {
    return Eigen::Matrix3d::Identity() - rows * covariance * rows.transpose();
}

/// The larger eigenvalue.
double largest(const Eigen::Matrix2d& symmetric) {
    const double half = 0.5 * symmetric.trace();
    return half + std::sqrt(std::fmax(0.0, half * half - symmetric.determinant()));
}

} // namespace

double left_out_chi2(const TouchRows& rows, const Eigen::Vector3d& residual, const Covariance& covariance) {
    return residual.dot(left_of(rows, covariance).ldlt().solve(residual));
}

double hidden_error_m(std::span<const TouchRows> touches, const Covariance& covariance,
                      std::span<const ZonePlace> places) {
    double worst2 = 0.0;
    for (const TouchRows& rows : touches) {
        const TouchRows moved = rows * covariance;
        // Of all errors b with b' left b = limit, that which moves the picture most: the ellipse's image.
        const Eigen::Matrix3d unseen = left_of(rows, covariance).inverse();
        for (const ZonePlace& place : places) {
            const Eigen::Matrix<double, 2, 3> by_error = place.rows * moved.transpose();
            worst2 = std::fmax(worst2, largest(by_error * unseen * by_error.transpose()));
        }
    }
    return std::sqrt(touch_chi2_limit * worst2);
}

} // namespace frustumscreen
