/// How far a picture lies beside the truth, to some hundredths of a pixel, whatever else is wrong with it.
///
/// Method   least squares over the picture: drawn(x) - truth(x) = -shift . gradient(x), in linear light, where the gradient is the
///          mean of both pictures' (Lucas & Kanade 1981; the mean makes it right to second order, Benhimane & Malis 2004). So a
///          picture that is too dark, or lacks a part, has a shift only as far as a shift explains the difference.
/// Units    projector pixels; x to the right, y down. Good to half a pixel or so; of a sharp edge up to a fifth too much.
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"

#include <optional>

namespace frustumscreen {

/// Of two pictures of one size, sRGB codes. None where they show no edge in one of the directions.
[[nodiscard]] std::optional<glm::dvec2> picture_shift(const Image8& truth, const Image8& drawn);

} // namespace frustumscreen
