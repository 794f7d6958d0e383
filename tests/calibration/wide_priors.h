/// Priors that say next to nothing: without noise the truth alone is found.
#pragma once

#include "app/calibration/priors.h"

namespace frustumscreen {

/// A thousand times as wide; how well a ruler knows the sensor's height stays.
[[nodiscard]] inline Priors wide_priors() {
    const Priors usual;
    return {1e3 * usual.aspect, 1e3 * usual.centre_u, 1e3 * usual.centre_v, 1e3 * usual.k1,
            1e3 * usual.k2,     1e3 * usual.print,    usual.sensor_height_m};
}

} // namespace frustumscreen
