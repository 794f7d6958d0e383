#include "app/calibration/reliability.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace frustumscreen {

namespace {

/// The covariance of a touch's residuals is what its own part in the fit leaves of the noise.
template <typename Rows, typename Matrix>
Eigen::Matrix3d left_of(const Rows& rows, const Matrix& covariance) {
    return Eigen::Matrix3d::Identity() - rows * covariance * rows.transpose();
}

/// The larger eigenvalue.
double largest(const Eigen::Matrix2d& symmetric) {
    const double half = 0.5 * symmetric.trace();
    return half + std::sqrt(std::fmax(0.0, half * half - symmetric.determinant()));
}

const LightRows& rows_of(const ZonePlace& place) {
    return place.rows;
}
const Eigen::Matrix2Xd& rows_of(const Eigen::Matrix2Xd& light) {
    return light;
}

double hidden_error(const auto& touches, const auto& covariance, const auto& places) {
    double worst2 = 0.0;
    for (const auto& rows : touches) {
        const auto moved = (rows * covariance).eval();
        // Of all errors b with b' left b = limit, that which moves the picture most: the ellipse's image.
        const Eigen::Matrix3d unseen = left_of(rows, covariance).inverse();
        for (const auto& place : places) {
            const Eigen::Matrix<double, 2, 3> by_error = rows_of(place) * moved.transpose();
            worst2 = std::fmax(worst2, largest(by_error * unseen * by_error.transpose()));
        }
    }
    return std::sqrt(touch_chi2_limit * worst2);
}

} // namespace

double left_out_chi2(const TouchRows& rows, const Eigen::Vector3d& residual, const Covariance& covariance) {
    return residual.dot(left_of(rows, covariance).ldlt().solve(residual));
}

double left_out_chi2(const Eigen::Matrix3Xd& rows, const Eigen::Vector3d& residual,
                     const Eigen::MatrixXd& covariance) {
    return residual.dot(left_of(rows, covariance).ldlt().solve(residual));
}

double hidden_error_m(std::span<const TouchRows> touches, const Covariance& covariance,
                      std::span<const ZonePlace> places) {
    return hidden_error(touches, covariance, places);
}

double hidden_error_m(std::span<const Eigen::Matrix3Xd> touches, const Eigen::MatrixXd& covariance,
                      std::span<const Eigen::Matrix2Xd> light) {
    return hidden_error(touches, covariance, light);
}

} // namespace frustumscreen
