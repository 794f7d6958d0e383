/// Finds the touches in which the prop stands as in most of them; in the others it lies on a side.
///
/// Threads  pure; any.
#pragma once

#include "app/calibration/touch.h"

#include <span>
#include <vector>

namespace frustumscreen::calibration {

/// `up`: the table's normal in K. Upright sensors see it in the same direction. One answer per touch.
[[nodiscard]] std::vector<bool> upright_ones(std::span<const Touch> touches, const glm::dvec3& up);

} // namespace frustumscreen::calibration
