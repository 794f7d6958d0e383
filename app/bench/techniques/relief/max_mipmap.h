/// Maximum mipmap of a dual-depth relief image: each texel bounds the material of the four below it.
///
/// Shape    level 0 is the image, each next level is half as wide and high, the last is 1 x 1. Sides are
///          powers of two.
/// Codes    as `material_along`: (low, high); low > high means no material.
/// Threads  pure; any.
/// Source   Tevs, Ihrke & Seidel 2008, here with the back's minimum in addition to the front's maximum.
#pragma once

#include "app/image/image.h"

#include <vector>

namespace frustumscreen::bench {

using MaxMipmap = std::vector<image::Image<glm::u16vec2>>;
[[nodiscard]] MaxMipmap max_mipmap(image::Image<glm::u16vec2> material);

} // namespace frustumscreen::bench
