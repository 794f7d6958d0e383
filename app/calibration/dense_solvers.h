/// Solvers of small dense problems of any size. Eigen compiles a solver anew for each fixed size in each file, which took a third of this
/// room's time; where a loop is waited for (choose_crosses.h), the fixed sizes stay.
///
/// Threads  pure; any.
#pragma once

#include <Eigen/Core>

namespace frustumscreen {

struct SymmetricAxes {
    Eigen::VectorXd values;  ///< eigenvalues, rising
    Eigen::MatrixXd vectors; ///< a column each, of length 1
};
[[nodiscard]] SymmetricAxes axes_of(const Eigen::MatrixXd& symmetric);
/// Of a symmetric, positive definite matrix: of an information, the covariance.
[[nodiscard]] Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& information);

} // namespace frustumscreen
