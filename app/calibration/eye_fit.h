/// Where a person's eyes are in the sensor on the head, from sightings over the prop: the exhibit's eye is the point between the two.
///
/// Method   linear least squares: in the sensor's frame each sighting is a line, and an eye is where its lines meet. Two equations a sighting, across
///          its line, whitened by their noise at the eye's distance; found anew a few times, since that distance is not known before. What
///          all sightings share (cross, tip) stands in the covariance, and not in the weights.
/// Wrong    the fewest sightings without which the others agree: one, or two. Each is judged by what all others say of it.
/// Frames   sensor S of the head.
/// Units    metres.
/// Errors   none: sightings from which nothing follows are refused, with a reason for the technician. docs/calibration.md says what a verdict promises.
/// Threads  pure; any.
#pragma once

#include "app/calibration/eye_sight.h"
#include "app/calibration/verdict.h"

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

namespace frustumscreen {

struct EyeFit {
    Verdict verdict = Verdict::Refused;
    std::string reason;              ///< one sentence
    std::vector<std::size_t> repeat; ///< sightings to do again, counted from 0
    /// Of each sighting: how far its line passes the eye that the others find. None if refused before anything was found.
    std::vector<double> residuals_m;
    double mean_residual_m = 0.0; ///< of the sightings that agree
    double worst_residual_m = 0.0;
    struct Eyes {
        glm::dvec3 left_m{0.0}, right_m{0.0}, middle_m{0.0};
        Eigen::Matrix3d covariance; ///< of the middle
        double picture_m = 0.0;     ///< what it puts on the picture, one standard deviation
        double hidden_m = 0.0;      ///< what one wrong sighting could do to the picture and yet agree
    };
    std::optional<Eyes> eyes; ///< none if refused
};

/// Sightings of each eye that are needed at least.
inline constexpr std::size_t least_sights = 4;

/// `deep_m`: how far behind a face a visitor sees a point of the artifact; to the prop's middle it is half its width. An eye that is off by e
/// across the line of sight puts e * deep_m / (from the eye to the prop) on the picture.
[[nodiscard]] EyeFit fit_eyes(std::span<const EyeSight> sights, double deep_m, const SightNoise& noise = {});

} // namespace frustumscreen
