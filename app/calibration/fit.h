/// Fits a model to touches: Levenberg-Marquardt on residuals that are whitened by the touches' noise.
///
/// A touch has three residuals: its pixel (2) and its height above the table. The tracker's noise enters all three, through the model; so
/// they are divided by their joint standard deviation at the current model, which is found anew a few times.
/// Robust   weights fall with a touch's own residual by Cauchy's function, where `robust` is asked for.
/// Solver   ceres::TinySolver: it is headers alone, so that a kiosk needs no library for it. 19 unknowns and dense rows are what it is made for.
/// Threads  pure; any.
#pragma once

#include "app/calibration/priors.h"
#include "app/calibration/unknowns.h"

#include <span>

namespace frustumscreen {

struct FitSetup {
    TouchNoise noise;
    Priors priors;
    std::optional<double>
        sensor_height_m;       ///< of the sensor above the touched place, in the touches that are `upright`
    std::vector<bool> upright; ///< of each touch; empty: all
};

struct Fit {
    TouchModel model;
    glm::dvec3 middle{0.0};         ///< about which the unknowns turn
    double chi2 = 0.0;              ///< sum of squares of the whitened residuals, priors included
    int freedom = 0;                ///< residuals and priors less unknowns
    std::vector<double> touch_chi2; ///< of each touch, three residuals together
    Covariance from_touches;        ///< information matrix of the touches alone
    Covariance from_height;         ///< of the sensor's height as given; zero without
    Covariance from_priors;
    [[nodiscard]] Covariance information() const { return from_touches + from_height + from_priors; }
};

/// `weights`: of each touch, 0 = not used; empty: all 1.
[[nodiscard]] Fit fit_touches(std::span<const Touch> touches, std::span<const double> weights,
                              const FitSetup& setup, const TouchModel& start);
/// The first steps of that: enough to see whether a start and a choice of touches lead anywhere.
[[nodiscard]] Fit fit_roughly(std::span<const Touch> touches, const FitSetup& setup, const TouchModel& start);
/// As fit_touches, with Cauchy's weights.
[[nodiscard]] Fit fit_robustly(std::span<const Touch> touches, const FitSetup& setup,
                               const TouchModel& start);

/// What touches tell at a model, without a fit: `middle` as the unknowns have it.
[[nodiscard]] Fit information_of(std::span<const Touch> touches, const FitSetup& setup,
                                 const TouchModel& model, const glm::dvec3& middle);
/// The whitened residuals of each touch, and how they change with the unknowns.
using TouchRows = Eigen::Matrix<double, 3, unknown_count>;
struct WhitenedTouches {
    std::vector<Eigen::Vector3d> residuals;
    std::vector<TouchRows> rows;
};
[[nodiscard]] WhitenedTouches whitened_touches(std::span<const Touch> touches, const FitSetup& setup,
                                               const TouchModel& model, const glm::dvec3& middle);

[[nodiscard]] glm::dvec3 middle_of(std::span<const Touch> touches);

} // namespace frustumscreen
