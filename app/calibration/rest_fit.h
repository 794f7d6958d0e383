/// Fits a model to rests: Levenberg-Marquardt, as fit.h for touches, with residuals that are whitened rest by rest.
///
/// A rest has two residuals for each point, its pixel, and three more if it stands on a block: the heights of three places of the prop's bottom.
/// Noise    the tracker's error moves all residuals of a rest together. It is not solved for, but stands in their covariance,
///          J S J^T + pixel noise, which gives the same answer (it is marginalised) with 22 unknowns for any number of rests.
/// Weights  a weight w makes the pixel noise of a point, or the tracker's noise of a rest, 1 / w of its variance.
/// Solver   ceres::TinySolver, as in fit.h.
/// Threads  pure; any.
#pragma once

#include "app/calibration/priors.h"
#include "app/calibration/rest_model.h"

#include <span>

namespace frustumscreen {

struct RestFitSetup {
    RestNoise noise;
    Priors priors;
    std::optional<double> sensor_height_m; ///< above the prop's bottom, in rests on a block
};

struct RestWeights {
    std::vector<std::vector<double>> points; ///< of each rest, of each point; > 0
    std::vector<double> rests;               ///< > 0
};
/// So small that what has it says nothing.
inline constexpr double no_weight = 1e-8;
[[nodiscard]] RestWeights equal_weights(std::span<const Rest> rests);

using PoseCovariance = Eigen::Matrix<double, 6, 6>;

/// What the fit leaves of a rest. Pose errors: a shift along K's axes and a turn about them at the sensor, in units of the tracker's noise.
struct FittedRest {
    Eigen::VectorXd residuals;                                            ///< whitened
    Eigen::Matrix<double, Eigen::Dynamic, rest_unknown_count> by_unknown; ///< of these, the derivatives
    Eigen::Matrix<double, Eigen::Dynamic, 6> by_pose;                     ///< and by a pose error
    Eigen::Matrix<double, 6, 1> pose; ///< the likeliest error of the tracker's report
    std::vector<glm::dvec2> points;   ///< what that leaves of each point, pixels
};

struct RestFit {
    RestModel model;
    glm::dvec3 middle{0.0};
    double chi2 = 0.0; ///< sum of squares of the whitened residuals, priors included
    int freedom = 0;   ///< residuals of points with weight and priors, less unknowns
    std::vector<FittedRest> rests;
    RestCovariance from_rests; ///< information matrices
    RestCovariance from_height;
    RestCovariance from_priors;
    [[nodiscard]] RestCovariance information() const { return from_rests + from_height + from_priors; }
};

/// `rounds`: how often the noise is carried through the model anew; each takes so many steps at most.
[[nodiscard]] RestFit fit_rests(std::span<const Rest> rests, const RestWeights& weights,
                                const RestFitSetup& setup, const RestModel& start,
                                std::span<const int> rounds);

[[nodiscard]] glm::dvec3 middle_of(std::span<const Rest> rests);

} // namespace frustumscreen
