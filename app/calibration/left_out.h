/// How far each touch lies off what all the others say of it.
///
/// Units    metres, pixels.
/// Threads  pure; any.
#pragma once

#include "app/calibration/field_fit.h"

namespace frustumscreen {

/// How far a touch is off what all others say of it.
struct TouchResidual {
    double on_table_m = 0.0; ///< from where the cross's light is to where the prop was
    double pixel = 0.0;
};

/// `model`: where each fit begins; the touches of `wrong` are in none.
[[nodiscard]] std::vector<TouchResidual> left_out_residuals(std::span<const Touch> touches,
                                                            std::span<const std::size_t> wrong,
                                                            const FitSetup& setup, const TouchModel& model);
/// The same with a map of the tracker's field, which each time is found anew from the others.
[[nodiscard]] std::vector<TouchResidual>
left_out_residuals(std::span<const Touch> touches, const FitSetup& setup, const BentFit& all, double bend_m);

} // namespace frustumscreen
