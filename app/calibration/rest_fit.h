/// Fits a model to rests: Levenberg-Marquardt as in fit.h, with residuals that are whitened rest by rest.
///
/// A rest has two residuals for each point, its pixel, and three more if it stands on a block: the heights of
/// three places of the prop's bottom.
/// Noise    The tracker's error moves all residuals of a rest together. It is marginalised: instead of being
///          solved for, it enters the residuals' covariance, J S J^T + pixel noise. The solution is the same,
///          with rest_unknown_count unknowns for any number of rests.
/// Weights  A weight w divides the variance of a point's pixel noise, or of a rest's tracker noise, by w.
/// Solver   ceres::TinySolver, as in fit.h.
/// Threads  pure; any.
#pragma once

#include "app/calibration/priors.h"
#include "app/calibration/rest_model.h"

#include <span>

namespace frustumscreen::calibration {

struct RestFitSetup {
    RestNoise noise;
    Priors priors;
    std::optional<double> sensor_height_m; ///< above the prop's bottom, for rests on a block
};

struct RestWeights {
    std::vector<std::vector<double>> points; ///< one list per rest, one weight per point; > 0
    std::vector<double> rests;               ///< > 0
};
/// A weight that makes a point or a rest negligible.
inline constexpr double no_weight = 1e-8;
[[nodiscard]] RestWeights equal_weights(std::span<const Rest> rests);

using PoseCovariance = Eigen::Matrix<double, 6, 6>;

/// Residuals of one rest after the fit. Pose errors: a shift along K's axes and a turn about them at the
/// sensor, in units of the tracker's noise.
struct FittedRest {
    Eigen::VectorXd residuals;                                            ///< whitened
    Eigen::Matrix<double, Eigen::Dynamic, rest_unknown_count> by_unknown; ///< derivatives of the residuals
    Eigen::Matrix<double, Eigen::Dynamic, 6> by_pose;                     ///< derivatives by a pose error
    Eigen::Matrix<double, 6, 1> pose; ///< most likely error of the tracker's report
    std::vector<glm::dvec2> points;   ///< residual of each point after that, pixels
};

struct RestFit {
    RestModel model;
    glm::dvec3 middle{0.0};
    double chi2 = 0.0; ///< sum of squares of the whitened residuals, priors included
    int freedom = 0;   ///< degrees of freedom: residuals of weighted points and priors, less unknowns
    std::vector<FittedRest> rests;
    RestCovariance from_rests; ///< information matrices
    RestCovariance from_height;
    RestCovariance from_priors;
    [[nodiscard]] RestCovariance information() const { return from_rests + from_height + from_priors; }
};

/// `rounds`: one entry per recomputation of the noise at the model, with its largest number of steps.
[[nodiscard]] RestFit fit_rests(std::span<const Rest> rests, const RestWeights& weights,
                                const RestFitSetup& setup, const RestModel& start,
                                std::span<const int> rounds);

[[nodiscard]] glm::dvec3 middle_of(std::span<const Rest> rests);

} // namespace frustumscreen::calibration
