/// The automatic calibration: the prop rests here and there on the table, a camera tells which pixels light known points of it, and from that come
/// projector and tracker, with a verdict. The camera itself need not be calibrated: it matches pixels with points, no more.
///
/// Frames   calibrated_table.h; the prop's as rest.h has it.
/// Units    metres, pixels.
/// Errors   none: rests from which nothing follows are refused with a reason for the technician.
/// Time     a tenth of a second for twenty rests.
/// Threads  pure; any.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "app/calibration/rest.h"

namespace frustumscreen {

struct AutoSetup {
    int width = 0; ///< the projector's picture
    int height = 0;
    std::optional<double> sensor_height_m; ///< above the prop's bottom; not needed where some rests lean
    double top_m = 0.12;                   ///< the prop's height: how far up the zone reaches
    RestNoise noise;
    Priors priors;
};

struct AutoCalibration {
    /// As a calibration by touch; residuals and `repeat` are of rests, means over their points. The touched place is the prop's bottom's middle.
    TouchCalibration found;
    RigidTransform sensor_from_prop;       ///< none if refused, as all that follows
    std::vector<std::size_t> points_wrong; ///< of each rest, how many were left out
    double print = 1.0;                    ///< how many times as large as it should be the sheet was printed
    double pixel_noise = 0.0;              ///< of a point, found; pixels
};

[[nodiscard]] AutoCalibration calibrate_auto(std::span<const Rest> rests, const AutoSetup& setup);

} // namespace frustumscreen
