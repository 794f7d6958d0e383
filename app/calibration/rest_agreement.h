/// Which rests and which of their points agree with each other, and which do not.
///
/// Method   Cauchy's weights for points and for the tracker's reports, beginning wide; then points beyond the noise are left out, and rests whose report
///          the others contradict, the worst first. The pixels' noise is found from the points: nobody knows it beforehand.
/// Threads  pure; any.
#pragma once

#include "app/calibration/agreement.h"
#include "app/calibration/plane_view.h"
#include "app/calibration/rest_fit.h"

namespace frustumscreen {

/// Of six residuals of a tracker's report that is right, one in ten thousand is beyond.
inline constexpr double rest_chi2_limit = 27.9;

struct AgreeingRests : Agreed { ///< never Exchanged; the scatter is the tracker's
    RestFit fit;
    RestWeights weights;      ///< 1 or no_weight
    double pixel_noise = 0.0; ///< found
};

/// `views` of each rest; `starts`: one at least.
[[nodiscard]] AgreeingRests find_agreement(std::span<const Rest> rests,
                                           std::span<const std::optional<PlaneView>> views,
                                           const RestFitSetup& setup, std::span<const RestModel> starts);

/// What the others leave of a wrong report of a rest unseen: covariance of the report's residuals, in units of the tracker's noise.
[[nodiscard]] PoseCovariance unexplained(const FittedRest& rest, const RestCovariance& covariance);

} // namespace frustumscreen
