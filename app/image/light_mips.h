/// A cut-out picture as light on a table, with its mip levels.
///
/// Colour   sRGB codes; averaged in linear light here, not by the driver (half_size).
/// Threads  pure; any.
#pragma once

#include "app/image/image.h"

#include <vector>

namespace frustumscreen::image {

/// The colours' light over black, opaque; finest first, down to one texel.
[[nodiscard]] std::vector<Image8> light_mips(const Image8& picture);

/// The same with the alpha kept: the colours' light times alpha.
[[nodiscard]] std::vector<Image8> cut_out_mips(const Image8& picture);

} // namespace frustumscreen::image
