/// Pictures for a person to compare: one part of each, next to each other, small ones enlarged.
///
/// Units    pixels, row 0 at the top.
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/bench/measures/measure.h"
#include "firmware_host/base/pixel_rectangle.h"

#include <span>

namespace frustumscreen::bench {

/// The rectangle around all non-zero pixels, with a margin of two pixels; empty if all are zero.
[[nodiscard]] PixelRectangle box_of(const image::Image<std::uint8_t>& mask);

/// The part must lie inside every picture.
[[nodiscard]] image::Image8 side_by_side(std::span<const image::Image8* const> pictures,
                                         const PixelRectangle& part);

/// Truth with 16 rays, the drawn picture, and the errors: red where only one of them shows the artifact,
/// elsewhere grey by the distance of the two hit points, white at `white_mm`.
inline constexpr float white_mm = 1.0F;
[[nodiscard]] image::Image8 error_picture(const TruthPicture& truth, const Drawn& drawn);

} // namespace frustumscreen::bench
