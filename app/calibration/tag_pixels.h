/// The projector's pixels at the corners of a tag, from what was decoded all over it.
///
/// A tag is flat, so that over it the projector's pixel follows the camera's by a homography, whatever the two lenses do at large. It is fitted to some
/// hundred decoded pixels: their noise nearly vanishes, and corners on black print, which decode badly, need not be decoded themselves.
/// Threads  pure; any.
#pragma once

#include "app/calibration/gray_code.h"

#include <array>

namespace frustumscreen {

/// `corners`: in the camera's picture, around the tag. Nothing, if too little around there is decoded.
[[nodiscard]] std::optional<std::array<glm::dvec2, 4>> tag_pixels(const PixelMap& map,
                                                                  const std::array<glm::dvec2, 4>& corners);

} // namespace frustumscreen
