/// The automatic calibration: the prop rests at several places on the table, and a camera finds the projector
/// pixel that lights each known point of it. From that the projector and the tracker are computed, with a
/// verdict. The camera itself needs no calibration: it only matches pixels with points.
///
/// Frames   calibrated_table.h; the prop's as in rest.h.
/// Units    metres, pixels.
/// Errors   none: rests that determine nothing are refused with a reason for the technician.
/// Time     0.1 s for twenty rests.
/// Threads  pure; any.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "app/calibration/rest.h"

namespace frustumscreen::calibration {

struct AutoSetup {
    int width = 0; ///< the projector's picture
    int height = 0;
    std::optional<double> sensor_height_m; ///< above the prop's bottom; not needed if some rests lean
    double top_m = 0.12;                   ///< the prop's height; the zone reaches up to it
    RestNoise noise;
    Priors priors;
};

struct AutoCalibration {
    /// As for a calibration by touch. Residuals and `repeat` refer to rests; a rest's residual is the mean
    /// over its points. The touched place is the middle of the prop's bottom.
    TouchCalibration found;
    geometry::RigidTransform sensor_from_prop; ///< meaningless if refused, like the members below
    std::vector<std::size_t> points_wrong;     ///< points left out, for each rest
    double print = 1.0;                        ///< the printed sheet's size over its nominal size
    double pixel_noise = 0.0;                  ///< estimated noise of a point, pixels
};

[[nodiscard]] AutoCalibration calibrate_auto(std::span<const Rest> rests, const AutoSetup& setup);

} // namespace frustumscreen::calibration
