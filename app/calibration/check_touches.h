/// Touches from which nothing can be computed, said before anything is: too few, in one plane or line, in wrong units, mirrored.
///
/// Method   affine fits: heights and pixels by the sensor's place. They are rough (a projector is not affine), and so are the limits; what is
///          finer is judged after the fit (determinacy.h).
/// Threads  pure; any.
#pragma once

#include "app/calibration/touch.h"

#include <optional>
#include <span>
#include <string>

namespace frustumscreen {

inline constexpr std::size_t least_touches = 6;

/// Why these touches are refused, one sentence for a technician; nothing if they are not. Quaternions are as reported, of any length.
[[nodiscard]] std::optional<std::string> refusal_of(std::span<const Touch> touches, int width, int height);

} // namespace frustumscreen
