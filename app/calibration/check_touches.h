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
inline constexpr std::size_t least_touch_up = 3; ///< of a table that was calibrated already

/// Why these touches are refused, one sentence for a technician; nothing if they are not. Quaternions are as reported, of any length.
[[nodiscard]] std::optional<std::string> refusal_of(std::span<const Touch> touches, int width, int height);

/// As that, of touches at a table that is known already: they need no two heights, and are held against it later.
[[nodiscard]] std::optional<std::string> refusal_of_few(std::span<const Touch> touches, int width,
                                                        int height);

/// The same touches, their quaternions of unit length.
[[nodiscard]] Touches with_unit_rotations(std::span<const Touch> touches);

} // namespace frustumscreen
