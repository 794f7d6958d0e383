/// The projector's pixels at a tag's corners, from the pixels decoded all over the tag.
///
/// A tag is flat, so a homography maps the camera's pixels on it to the projector's, whatever the distortion
/// of the two lenses. It is fitted to some hundred decoded pixels, which averages their noise. Corners on
/// black print, which decode badly, need no decoding.
/// Threads  pure; any.
#pragma once

#include "app/calibration/gray_code.h"

#include <array>

namespace frustumscreen::calibration {

/// `corners`: of the tag in the camera's picture, in order around it. Nothing if too few pixels there are
/// decoded.
[[nodiscard]] std::optional<std::array<glm::dvec2, 4>> tag_pixels(const PixelMap& map,
                                                                  const std::array<glm::dvec2, 4>& corners);

} // namespace frustumscreen::calibration
