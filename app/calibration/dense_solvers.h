/// Solvers for small dense problems of any size. Eigen compiles a solver for each fixed size in each file, a
/// third of this module's build time. choose_crosses.cpp keeps fixed sizes, because a person waits for its
/// loop.
///
/// Threads  pure; any.
#pragma once

#include <Eigen/Core>

namespace frustumscreen::calibration {

struct SymmetricAxes {
    Eigen::VectorXd values;  ///< eigenvalues, rising
    Eigen::MatrixXd vectors; ///< unit columns
};
[[nodiscard]] SymmetricAxes axes_of(const Eigen::MatrixXd& symmetric);
/// Inverse of a symmetric, positive definite matrix: the covariance of an information matrix.
[[nodiscard]] Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& information);

} // namespace frustumscreen::calibration
