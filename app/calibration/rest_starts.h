/// Starts of the fit to rests: the starts of touches, as if the middle of each rest's level had been laid on
/// its pixel.
///
/// Threads  pure; any.
#pragma once

#include "app/calibration/plane_view.h"
#include "app/calibration/rest_model.h"
#include "app/calibration/touch.h"

#include <span>

namespace frustumscreen::calibration {

/// Rests on blocks that have a view, as touches of their levels' middles.
[[nodiscard]] Touches as_touches(std::span<const Rest> rests,
                                 std::span<const std::optional<PlaneView>> views);

/// `views`: at least one of a rest on a block.
[[nodiscard]] std::vector<RestModel> starting_rest_models(std::span<const Rest> rests,
                                                          std::span<const std::optional<PlaneView>> views,
                                                          int width, int height);

} // namespace frustumscreen::calibration
