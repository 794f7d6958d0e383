/// Whether touches are told better by a map of the tracker's field than without one, beyond chance.
///
/// Test     each touch, left out, lies off what the others say of it: with the map and without. Wilcoxon's signed-rank test (1945), one-sided, on
///          these pairs at one in a hundred, and a root mean square that falls by a tenth or more. A map whose touches do not agree with it
///          within twice the noise is none, whatever it gains. docs/calibration.md has how often it errs.
/// Threads  pure; any.
#pragma once

#include "app/calibration/left_out.h"

namespace frustumscreen {

struct BentTouches {
    BentFit bent;
    std::vector<TouchResidual> residuals; ///< left out, with the map
    double without_map_m = 0.0;           ///< of the same touches: root mean square
    double with_map_m = 0.0;
    double chance = 1.0;         ///< of gaining as much from nothing, by the test
    double scatter = 1.0;        ///< noise found over noise expected, at least 1
    double largest_bend_m = 0.0; ///< of the touches' places, by the map
};

/// Nothing where a map gains nothing. `without`: the fit of all touches.
[[nodiscard]] std::optional<BentTouches> find_bend(std::span<const Touch> touches, const FitSetup& setup,
                                                   const Fit& without);

/// Of pairs whose differences are these: how likely as many and as large positive ones are if neither sign is.
[[nodiscard]] double signed_rank_chance(std::span<const double> differences);

} // namespace frustumscreen
