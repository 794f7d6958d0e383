/// The picture errors that the noise of touches causes in the best possible calibration, propagated to first
/// order.
///
/// Derivatives are differences of the simulated table's arithmetic; nothing of the fit is used.
/// Units    metres
/// Source   Kay, Fundamentals of Statistical Signal Processing: Estimation Theory, 1993: the Cramer-Rao bound
///          with priors
#pragma once

#include "app/calibration/priors.h"
#include "tests/simulators/table/simulated_table.h"

#include <Eigen/Core>
#include <vector>

namespace frustumscreen::calibration {

struct PropagatedTouches {
    Eigen::MatrixXd
        by_noise; ///< three rows per place of registration_offsets, a column per standard normal number
    Eigen::VectorXd bias;                   ///< shift of the picture by the priors
    std::vector<Eigen::Matrix3d> whitening; ///< of each touch's pixel and height
};

/// `touches`: without noise. `top_m`: the zone's height, as for registration_offsets.
[[nodiscard]] PropagatedTouches propagated_touches(const simulators::SimulatedTable& table,
                                                   const std::vector<Touch>& touches, const TouchNoise& noise,
                                                   const Priors& priors, double top_m);

/// The picture's offsets for these touches, with their noise: rows as in by_noise.
[[nodiscard]] Eigen::VectorXd offsets_by(const PropagatedTouches& propagated,
                                         const simulators::SimulatedTable& table,
                                         const std::vector<Touch>& touches);

/// The expected mean of the squared error over the places, and the variance of that mean.
struct SquareError {
    double mean_m2 = 0.0;
    double variance_m4 = 0.0;
};
[[nodiscard]] SquareError square_error(const PropagatedTouches& propagated);

/// The error at the worst place in each of `draws` calibrations, in ascending order.
[[nodiscard]] std::vector<double> worst_places(const PropagatedTouches& propagated, int draws,
                                               simulators::SeededNumbers& numbers);

} // namespace frustumscreen::calibration
