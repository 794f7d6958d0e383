/// Fits a model to touches: Levenberg-Marquardt on residuals that are whitened by the touches' noise.
///
/// A touch has three residuals: its pixel (2) and its height above the table. The tracker's noise enters all
/// three through the model. They are therefore whitened by their joint covariance at the current model, which
/// is recomputed a few times.
/// Robust   On request, weights decrease with a touch's residual by Cauchy's function.
/// Solver   ceres::TinySolver: header-only, so a kiosk needs no library for it. It is made for small dense
///          problems; this one has 19 unknowns.
/// Threads  pure; any.
#pragma once

#include "app/calibration/priors.h"
#include "app/calibration/unknowns.h"

#include <span>

namespace frustumscreen::calibration {

struct FitSetup {
    TouchNoise noise;
    Priors priors;
    std::optional<double>
        sensor_height_m;       ///< the sensor's height above the touched place in `upright` touches
    std::vector<bool> upright; ///< of each touch; empty: all
};

struct Fit {
    TouchModel model;
    glm::dvec3 middle{0.0};         ///< origin of the unknowns' rotations
    double chi2 = 0.0;              ///< sum of squares of the whitened residuals, priors included
    int freedom = 0;                ///< degrees of freedom: residuals and priors less unknowns
    std::vector<double> touch_chi2; ///< of each touch's three residuals together
    Covariance from_touches;        ///< information matrix of the touches alone
    Covariance from_height;         ///< of the given sensor height; zero without one
    Covariance from_priors;
    [[nodiscard]] Covariance information() const { return from_touches + from_height + from_priors; }
};

/// `weights`: one per touch, 0 = not used; empty: all 1.
[[nodiscard]] Fit fit_touches(std::span<const Touch> touches, std::span<const double> weights,
                              const FitSetup& setup, const TouchModel& start);
/// A fit with few steps, enough to see whether a start and a choice of touches converge.
[[nodiscard]] Fit fit_roughly(std::span<const Touch> touches, const FitSetup& setup, const TouchModel& start);
/// As fit_touches, with Cauchy's weights.
[[nodiscard]] Fit fit_robustly(std::span<const Touch> touches, const FitSetup& setup,
                               const TouchModel& start);

/// Information of touches at a model, without a fit; `middle`: as in unknowns.h.
[[nodiscard]] Fit information_of(std::span<const Touch> touches, const FitSetup& setup,
                                 const TouchModel& model, const glm::dvec3& middle);
/// The whitened residuals of each touch, and their derivatives by the unknowns.
using TouchRows = Eigen::Matrix<double, 3, unknown_count>;
struct WhitenedTouches {
    std::vector<Eigen::Vector3d> residuals;
    std::vector<TouchRows> rows;
};
[[nodiscard]] WhitenedTouches whitened_touches(std::span<const Touch> touches, const FitSetup& setup,
                                               const TouchModel& model, const glm::dvec3& middle);

[[nodiscard]] glm::dvec3 middle_of(std::span<const Touch> touches);

} // namespace frustumscreen::calibration
