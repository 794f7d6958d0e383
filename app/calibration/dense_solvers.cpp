#include "app/calibration/dense_solvers.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace frustumscreen::calibration {

SymmetricAxes axes_of(const Eigen::MatrixXd& symmetric) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& information) {
    return information.ldlt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
}

} // namespace frustumscreen::calibration
