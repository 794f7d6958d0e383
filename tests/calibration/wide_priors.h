/// Priors with hardly any information: without noise the fit finds the truth exactly.
#pragma once

#include "app/calibration/priors.h"

namespace frustumscreen::calibration {

/// Priors a thousand times as wide; the sensor's height keeps a ruler's accuracy.
[[nodiscard]] inline Priors wide_priors() {
    const Priors usual;
    return {.aspect = 1e3 * usual.aspect,
            .centre_u = 1e3 * usual.centre_u,
            .centre_v = 1e3 * usual.centre_v,
            .k1 = 1e3 * usual.k1,
            .k2 = 1e3 * usual.k2,
            .boards = 1e3 * usual.boards,
            .print = 1e3 * usual.print,
            .sensor_height_m = usual.sensor_height_m};
}

} // namespace frustumscreen::calibration
