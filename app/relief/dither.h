/// The picture's pixels that one of two pictures takes, with all their samples: an ordered pattern. A picture with a
/// share and one with its complement take each pixel exactly once together: no pixel is mixed and none is left out.
///
/// Threads  values; any.
/// Source   Bayer 1973: thresholds in 8 x 8 pixels (app/render/shader_source.cpp, rasterize_blocks.cpp).
#pragma once

namespace frustumscreen::relief {

struct Dither {
    float share = 1.0F;      ///< 0..1
    bool complement = false; ///< the pixels that the share leaves

    [[nodiscard]] bool operator==(const Dither&) const = default;
};

} // namespace frustumscreen::relief
