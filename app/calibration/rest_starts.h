/// Where the fit of a model to rests begins: the touches' starts, for the middle of each rest's level as if it had been laid on its pixel.
///
/// Threads  pure; any.
#pragma once

#include "app/calibration/plane_view.h"
#include "app/calibration/rest_model.h"
#include "app/calibration/touch.h"

#include <span>

namespace frustumscreen {

/// The rests on blocks as touches of their levels' middles; those that have a view.
[[nodiscard]] Touches as_touches(std::span<const Rest> rests,
                                 std::span<const std::optional<PlaneView>> views);

/// `views`: of one rest on a block at least.
[[nodiscard]] std::vector<RestModel> starting_rest_models(std::span<const Rest> rests,
                                                          std::span<const std::optional<PlaneView>> views,
                                                          int width, int height);

} // namespace frustumscreen
