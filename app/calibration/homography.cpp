#include "app/calibration/homography.h"

#include "app/calibration/dense_solvers.h"

#include <Eigen/LU>

namespace frustumscreen::calibration {

namespace {

/// Maps points about their middle to a mean distance of 1.
Eigen::Matrix3d scaling(std::span<const Eigen::Vector2d> points) {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& point : points) {
        middle += point / static_cast<double>(points.size());
    }
    double reach = 1e-12;
    for (const Eigen::Vector2d& point : points) {
        reach += (point - middle).norm() / static_cast<double>(points.size());
    }
    Eigen::Matrix3d scale = Eigen::Matrix3d::Identity() / reach;
    scale.col(2) << -middle / reach, 1.0;
    return scale;
}

} // namespace

std::optional<Eigen::Matrix3d> homography(std::span<const Eigen::Vector2d> from,
                                          std::span<const Eigen::Vector2d> to) {
    if (from.size() < 4) {
        return std::nullopt;
    }
    const Eigen::Matrix3d scale_from = scaling(from);
    const Eigen::Matrix3d scale_to = scaling(to);
    using Square = Eigen::Matrix<double, 9, 9>;
    Square sum = Square::Zero();
    for (std::size_t k = 0; k < from.size(); ++k) {
        const Eigen::RowVector3d x = (scale_from * from[k].homogeneous()).transpose();
        const Eigen::Vector3d u = scale_to * to[k].homogeneous();
        Eigen::Matrix<double, 2, 9> rows;
        rows << x, Eigen::RowVector3d::Zero(), -u.x() * x, Eigen::RowVector3d::Zero(), x, -u.y() * x;
        sum += rows.transpose() * rows;
    }
    const SymmetricAxes axes = axes_of(sum);
    constexpr double least = 1e-4; // of the second eigenvalue: only one direction may be undetermined
    if (!(axes.values[1] > least)) {
        return std::nullopt;
    }
    const Eigen::Matrix<double, 9, 1> h = axes.vectors.col(0);
    Eigen::Matrix3d scaled;
    scaled << h.segment<3>(0).transpose(), h.segment<3>(3).transpose(), h.segment<3>(6).transpose();
    return scale_to.inverse() * scaled * scale_from;
}

} // namespace frustumscreen::calibration
