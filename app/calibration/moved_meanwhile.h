/// Finds out whether the projector or the tracker's source moved while the crosses were touched.
///
/// Method   From some touch on, all places are displaced by one rigid move along the table: three unknowns. Each touch is
///          tried as the first after the move; at least three touches lie before it and after it. A projector that was
///          turned a little displaces the places in the same way, so the two are not told apart.
/// Limits   A move between the touches on the table and those on boards looks like a projector that hangs elsewhere.
/// Threads  pure; any.
#pragma once

#include "app/calibration/extra_unknowns.h"

#include <optional>

namespace frustumscreen::calibration {

/// The move that explains most; nothing if the touches are too few. `all`: the fit to these touches.
[[nodiscard]] std::optional<Disturbance> moved_meanwhile(std::span<const Touch> touches,
                                                         const FitSetup& setup, const FittedTouches& all);

} // namespace frustumscreen::calibration
