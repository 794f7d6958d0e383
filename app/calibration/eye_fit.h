/// Finds a person's eyes in the frame of the head's sensor from sightings over the prop. The exhibit uses the
/// point between the two eyes.
///
/// Method   Linear least squares: each sighting is a line in the sensor's frame, and an eye is the
///          intersection of its lines. A sighting gives two equations, across its line, whitened by the noise
///          at the eye's distance. That distance is unknown at first, so the fit is repeated a few times.
///          Errors that all sightings share (cross, tip) enter the covariance, not the weights.
/// Wrong    Finds the fewest sightings without which the others agree: one or two. Each is judged by a fit of
///          all the others.
/// Frames   sensor S of the head.
/// Units    metres.
/// Errors   none: sightings that determine nothing are refused with a reason for the technician.
///          docs/calibration.md says what a verdict promises.
/// Threads  pure; any.
#pragma once

#include "app/calibration/eye_sight.h"
#include "app/calibration/verdict.h"

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

namespace frustumscreen::calibration {

struct FittedEyes {
    glm::dvec3 left_m{0.0}, right_m{0.0}, middle_m{0.0};
    Eigen::Matrix3d covariance; ///< of the middle
    double picture_m = 0.0;     ///< its effect on the picture, one standard deviation
    double hidden_m = 0.0;      ///< largest picture error from one wrong sighting that goes unnoticed
};

struct EyeFit {
    Verdict verdict = Verdict::Refused;
    VerdictReason reason;
    std::vector<std::size_t> repeat; ///< sightings to do again, counted from 0
    /// Distance of each sighting's line from the eye that the others determine. Empty if refused before a
    /// fit.
    std::vector<double> residuals_m;
    double mean_residual_m = 0.0; ///< of the sightings that agree
    double worst_residual_m = 0.0;
    std::optional<FittedEyes> eyes; ///< none if refused
};

/// Least number of sightings of each eye.
inline constexpr std::size_t min_sights = 4;

/// `deep_m`: distance behind a face at which a visitor sees a point of the artifact; the prop's middle is
/// half the prop's width behind it. An eye error e across the line of sight moves the picture by e * deep_m /
/// (distance from the eye to the prop).
[[nodiscard]] EyeFit fit_eyes(std::span<const EyeSight> sights, double deep_m, const SightNoise& noise = {});

} // namespace frustumscreen::calibration
