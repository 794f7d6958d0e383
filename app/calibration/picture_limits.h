/// The limits of the verdicts (docs/calibration.md): standard deviations of the picture over the zone, and
/// the largest unnoticed error of a wrong touch.
///
/// Units    metres.
/// Threads  values; any.
#pragma once

#include "app/calibration/zone.h"

namespace frustumscreen::calibration {

struct PictureLimits {
    double mean_m;
    double worst_m;
    double hidden_m;
    [[nodiscard]] bool keep(const PictureUncertainty& uncertainty, double hidden_error_m) const {
        return uncertainty.mean_m <= mean_m && uncertainty.worst_m <= worst_m && hidden_error_m <= hidden_m;
    }
};
inline constexpr PictureLimits for_good{0.7e-3, 1.4e-3, 16e-3};
inline constexpr PictureLimits for_usable{1.2e-3, 2.5e-3, 40e-3};

} // namespace frustumscreen::calibration
