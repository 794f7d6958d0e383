/// Uncertainty of the picture over the zone after a calibration by hand: the effect of the ruler's error on
/// where each pixel's light falls.
///
/// Method   The ruler's error is estimated from the corners' distances to their rays, and is at least 1 mm.
///          Each coordinate is changed a little and the calibration repeated; the moves of each light add up
///          in squares. Lens distortion and the tracker are not included.
/// Frames   as corners.h; heights above z = 0.
/// Units    metres.
/// Threads  pure; any.
#pragma once

#include "app/calibration/corners.h"
#include "app/calibration/zone.h"

namespace frustumscreen::calibration {

inline constexpr double min_ruler_error_m = 1e-3;

struct CornerUncertainty {
    double ruler_error_m = 0.0;         ///< of each coordinate, one standard deviation
    PictureUncertainty picture;         ///< over the zone
    std::vector<PlaceUncertainty> zone; ///< zone_columns x zone_rows of each height, from the table up
};

/// `calibration`: of `corners`, and not refused. `top_m`: the prop's height.
[[nodiscard]] CornerUncertainty uncertainty_of(const CornerCalibration& calibration,
                                               std::span<const MeasuredCorner> corners, double top_m);

} // namespace frustumscreen::calibration
