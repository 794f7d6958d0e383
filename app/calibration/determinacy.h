/// Finds what the points do not determine.
///
/// Method   Uses the information of the touches with priors ten times as wide as in the fit, so that no
///          answer comes from the priors alone. The sensor's place in the prop is judged by its own
///          covariance, whose widest direction names what is missing; all else by the picture's uncertainty.
/// Threads  pure; any.
#pragma once

#include "app/calibration/fit.h"
#include "app/calibration/zone.h"

namespace frustumscreen::calibration {

struct Undetermined {
    enum class What {
        SensorAcross, ///< the sensor's place across the prop: the prop was never turned
        SensorAbove,  ///< the sensor's height: the prop was always upright
        Picture,
    };
    What what = What::Picture;
    double picture_m = 0.0; ///< uncertainty of the picture
};

/// The undetermined part of a fit; nothing if the points determine everything. Uses only the fit's middle and
/// its three information matrices.
[[nodiscard]] std::optional<Undetermined> undetermined(const Fit& fit, const ZoneSetup& zone);

/// Share of an unknown's information that comes from its prior: 0 = none, 1 = all.
struct PriorShares {
    double aspect = 0.0, centre_u = 0.0, centre_v = 0.0, k1 = 0.0, k2 = 0.0;
};
[[nodiscard]] PriorShares prior_shares(const Fit& fit);

} // namespace frustumscreen::calibration
