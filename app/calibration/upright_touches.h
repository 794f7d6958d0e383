/// The touches in which the prop stands as in most of them; in the others it lies on a side.
///
/// Threads  pure; any.
#pragma once

#include "app/calibration/touch.h"

#include <span>
#include <vector>

namespace frustumscreen {

/// `up`: the table's, in K; it lies alike in the frames of the sensors that are upright. One answer for each touch.
[[nodiscard]] std::vector<bool> upright_ones(std::span<const Touch> touches, const glm::dvec3& up);

} // namespace frustumscreen
