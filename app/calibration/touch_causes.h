/// Why touches contradict each other: each cause is tested by undoing it.
///
/// Mistakes      affect all touches: a mirrored picture, a list that is shifted by one cross or reversed. One is the
///               cause if the touches agree once it is undone.
/// Disturbances  affect some touches alike: the projector or the tracker's source moved meanwhile, or metal is near. One is
///               the cause if the rest is noise, and if neither chance nor a few wrong touches explain as much.
/// Threads       pure; any.
#pragma once

#include "app/calibration/agreement.h"
#include "app/calibration/verdict.h"

#include <optional>
#include <span>

namespace frustumscreen::calibration {

/// Returns no reason if none of the mistakes explains the misfit. `setup`: the setup of the touches as given.
[[nodiscard]] std::optional<VerdictReason> mistake_in(std::span<const Touch> touches, const FitSetup& setup,
                                                      int width, int height);
/// Returns no reason if no disturbance explains the misfit. `found`: the touches that agree without one.
[[nodiscard]] std::optional<VerdictReason>
disturbance_of(std::span<const Touch> touches, const FitSetup& setup, const AgreeingTouches& found);

} // namespace frustumscreen::calibration
