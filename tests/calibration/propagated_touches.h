/// The picture errors that the noise of touches makes in the best possible calibration, propagated to first order.
///
/// Derivatives are differences of the simulated table's arithmetic; nothing of the fit is used.
/// Units    metres
/// Source   Kay, Fundamentals of Statistical Signal Processing: Estimation Theory, 1993: the Cramer-Rao bound with priors
#pragma once

#include "app/calibration/priors.h"
#include "tests/simulators/table/simulated_table.h"

#include <Eigen/Core>
#include <vector>

namespace frustumscreen {

struct PropagatedTouches {
    Eigen::MatrixXd
        by_noise; ///< three rows for each place of registration_offsets; a column for each standard normal number
    Eigen::VectorXd bias;                   ///< where the priors pull the picture to
    std::vector<Eigen::Matrix3d> whitening; ///< of each touch's pixel and height
};

/// `touches`: without noise. `top_m`: the zone's height, as for registration_offsets.
[[nodiscard]] PropagatedTouches propagated_touches(const SimulatedTable& table,
                                                   const std::vector<Touch>& touches, const TouchNoise& noise,
                                                   const Priors& priors, double top_m);

/// Where these touches, with their noise, put the picture: rows as of by_noise.
[[nodiscard]] Eigen::VectorXd offsets_by(const PropagatedTouches& propagated, const SimulatedTable& table,
                                         const std::vector<Touch>& touches);

/// Over the places, the expected mean of the squared error, and the variance of that mean.
struct SquareError {
    double mean_m2 = 0.0;
    double variance_m4 = 0.0;
};
[[nodiscard]] SquareError square_error(const PropagatedTouches& propagated);

/// The error at the worst place in `draws` calibrations, in ascending order.
[[nodiscard]] std::vector<double> worst_places(const PropagatedTouches& propagated, int draws,
                                               SeededNumbers& numbers);

} // namespace frustumscreen
