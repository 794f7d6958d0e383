/// How uncertain the picture of a calibration by hand is, all over the zone: what the ruler's error does to where each pixel's light is.
///
/// Method   the ruler's error is told from how far the corners lie beside their rays, and is a millimetre at least; each coordinate is changed a
///          little, the calibration done again, and how each light moves adds up. A lens that distorts is not in it, and no tracker.
/// Frames   as corners.h; heights above z = 0.
/// Units    metres.
/// Threads  pure; any.
#pragma once

#include "app/calibration/corners.h"
#include "app/calibration/zone.h"

namespace frustumscreen {

inline constexpr double least_ruler_error_m = 1e-3;

struct CornerUncertainty {
    double ruler_error_m = 0.0;         ///< of each coordinate, one standard deviation
    PictureUncertainty picture;         ///< over the zone
    std::vector<PlaceUncertainty> zone; ///< zone_columns x zone_rows of each height, from the table up
};

/// `calibration` is that of `corners`, and not refused. `top_m`: the prop's height.
[[nodiscard]] CornerUncertainty uncertainty_of(const CornerCalibration& calibration,
                                               std::span<const MeasuredCorner> corners, double top_m);

} // namespace frustumscreen
