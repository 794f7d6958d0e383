/// What touches do not determine, and in a technician's words what to do about it.
///
/// Method   the information of the touches with priors ten times as wide as those of the fit, so that no answer is the priors' own. The sensor's
///          place in the prop by its own covariance, whose widest direction names what is missing; the rest by the picture that it leaves.
/// Threads  pure; any.
#pragma once

#include "app/calibration/fit.h"
#include "app/calibration/zone.h"

#include <string>

namespace frustumscreen {

/// Why this fit is none; nothing if the touches determine it.
[[nodiscard]] std::optional<std::string> undetermined(const Fit& fit, const ZoneSetup& zone);

/// Of what is known of an unknown, the share that comes from its prior: 0 = nothing, 1 = all.
struct PriorShares {
    double aspect = 0.0, centre_u = 0.0, centre_v = 0.0, k1 = 0.0, k2 = 0.0;
};
[[nodiscard]] PriorShares prior_shares(const Fit& fit);

} // namespace frustumscreen
