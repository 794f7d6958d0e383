/// Finds the rests and points that agree with each other, and those that do not.
///
/// Method   Cauchy weights for points and for the tracker's reports, wide at first. Then points beyond the
///          noise are left out, and so are rests whose report contradicts the others, worst first. The pixel
///          noise is estimated from the points.
/// Threads  pure; any.
#pragma once

#include "app/calibration/agreement.h"
#include "app/calibration/plane_view.h"
#include "app/calibration/rest_fit.h"

namespace frustumscreen::calibration {

/// 99.99 % quantile of chi squared for the six residuals of a correct tracker report.
inline constexpr double rest_chi2_limit = 27.9;

struct AgreeingRests : Agreed { ///< never Exchanged; `scatter` is the tracker's
    RestFit fit;
    RestWeights weights;      ///< each is 1 or no_weight
    double pixel_noise = 0.0; ///< estimated
};

/// `views`: one per rest. `starts`: at least one.
[[nodiscard]] AgreeingRests find_agreement(std::span<const Rest> rests,
                                           std::span<const std::optional<PlaneView>> views,
                                           const RestFitSetup& setup, std::span<const RestModel> starts);

/// The part of a report's errors that the other rests do not reveal: covariance of the report's residuals, in
/// units of the tracker's noise.
[[nodiscard]] PoseCovariance unexplained(const FittedRest& rest, const RestCovariance& covariance);

} // namespace frustumscreen::calibration
