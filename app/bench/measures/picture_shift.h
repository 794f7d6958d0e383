/// How far a picture is displaced from the truth, to a few hundredths of a pixel, independent of other
/// errors.
///
/// Method   least squares over the picture: drawn(x) - truth(x) = -shift . gradient(x), in linear light,
///          where the gradient is the mean of both pictures' gradients (Lucas & Kanade 1981; the mean makes
///          it correct to second order, Benhimane & Malis 2004). A picture that is too dark, or lacks a part,
///          has a shift only as far as a shift explains the difference.
/// Units    projector pixels; x to the right, y down. Valid up to about half a pixel; for a sharp edge up to
///          a fifth too large.
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"

#include <optional>

namespace frustumscreen::bench {

/// Compares two pictures of one size, sRGB codes. nullopt if they show no edge in one of the directions.
[[nodiscard]] std::optional<glm::dvec2> picture_shift(const image::Image8& truth, const image::Image8& drawn);

} // namespace frustumscreen::bench
