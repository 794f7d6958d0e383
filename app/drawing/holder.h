/// A holder for a prop in the hand: a plate with a rim around the prop's foot, in which it stands upright at one place.
///
/// Frame    the prop's, from above; metres.
/// Method   the pocket is as wide as the widest part of the prop up to the rim's height, so that a prop that widens upward
///          goes in from above too.
/// Threads  pure; any.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/settings/polygon.h"

namespace frustumscreen::drawing {

struct Holder {
    settings::Polygon pocket; ///< inside of the rim: the prop with the play around it
    settings::Polygon plate;  ///< outside of the rim, and of the plate below
    double plate_m = 0.0;     ///< thickness
    double rim_m = 0.0;       ///< height above the plate
};

/// Between the prop and the rim, on each side: what a print and a coat of paint need.
inline constexpr double holder_play_m = 0.0005;
inline constexpr double holder_rim_width_m = 0.008;
[[nodiscard]] Holder holder_for(const geometry::PropShape& prop);

} // namespace frustumscreen::drawing
