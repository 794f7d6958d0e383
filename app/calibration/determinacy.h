/// What points do not determine.
///
/// Method   the information of the touches with priors ten times as wide as those of the fit, so that no answer is the priors' own. The sensor's
///          place in the prop by its own covariance, whose widest direction names what is missing; the rest by the picture that it leaves.
/// Threads  pure; any.
#pragma once

#include "app/calibration/fit.h"
#include "app/calibration/zone.h"

namespace frustumscreen {

struct Undetermined {
    enum class What {
        SensorAcross, ///< where in the prop the sensor sits: it was not turned
        SensorAbove,  ///< how high it sits: the prop was upright always
        Picture,
    };
    What what = What::Picture;
    double picture_m = 0.0; ///< how far open the picture is
};

/// Of a fit; nothing if the points determine all. Its middle and its three information matrices are what counts.
[[nodiscard]] std::optional<Undetermined> undetermined(const Fit& fit, const ZoneSetup& zone);

/// Of what is known of an unknown, the share that comes from its prior: 0 = nothing, 1 = all.
struct PriorShares {
    double aspect = 0.0, centre_u = 0.0, centre_v = 0.0, k1 = 0.0, k2 = 0.0;
};
[[nodiscard]] PriorShares prior_shares(const Fit& fit);

} // namespace frustumscreen
