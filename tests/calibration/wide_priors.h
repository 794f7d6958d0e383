/// Priors with hardly any information: without noise the fit finds the truth exactly.
#pragma once

#include "app/calibration/priors.h"

namespace frustumscreen {

/// Priors a thousand times as wide; the sensor's height keeps a ruler's accuracy.
[[nodiscard]] inline Priors wide_priors() {
    const Priors usual;
    return {1e3 * usual.aspect, 1e3 * usual.centre_u, 1e3 * usual.centre_v, 1e3 * usual.k1,
            1e3 * usual.k2,     1e3 * usual.print,    usual.sensor_height_m};
}

} // namespace frustumscreen
