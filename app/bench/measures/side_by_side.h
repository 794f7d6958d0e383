/// Pictures that a person compares: the same part of each, side by side, small ones enlarged.
///
/// Units    pixels, row 0 at the top.
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/bench/measures/measure.h"
#include "firmware_host/base/pixel_rectangle.h"

#include <span>

namespace frustumscreen {

/// The rectangle around all pixels that are not zero, with a rim of two pixels; empty if all are zero.
[[nodiscard]] PixelRectangle box_of(const Image<std::uint8_t>& mask);

/// The part must lie inside every picture.
[[nodiscard]] Image8 side_by_side(std::span<const Image8* const> pictures, const PixelRectangle& part);

/// Truth of 16 rays, what was drawn, and where it is wrong: red where one alone shows the artifact, elsewhere
/// grey by the distance of the two hit points, white at `white_mm`.
inline constexpr float white_mm = 1.0F;
[[nodiscard]] Image8 error_picture(const TruthPicture& truth, const Drawn& drawn);

} // namespace frustumscreen
