/// Sets a shaped text (app/pack/glyph_runs.h) as a picture of its coverage, at any size.
///
/// Units    pixels; `em_px` is the type size. Coverage is linear light, 255 = white; row 0 at the text's top.
/// Threads  pure; any. Once for each text and size, never in a frame: it allocates.
/// Errors   none. A picture of more than 16384 pixels a side, or 2^24 in all, is empty.
/// Method   each pixel is the mean of 4 x 4 samples of the distance to the outline, so that strokes thinner
///          than a pixel keep their weight. Touching glyphs join without a seam, because samples take the
///          larger value.
#pragma once

#include "app/image/image.h"
#include "app/pack/glyph_runs.h"

#include <cstdint>

namespace frustumscreen::typography {

/// The picture's size; 0 if it is empty.
struct GlyphExtent {
    int width_px = 0, height_px = 0;
    int left_px = 0; ///< pixels left of the setting's box: letters may extend beyond its edges
    int top_px = 0;  ///< pixels above it
};
/// The size without drawing. `setting` is one of `runs`.
[[nodiscard]] GlyphExtent glyph_extent(const pack::GlyphRuns& runs, const pack::GlyphSetting& setting,
                                       double em_px);

struct GlyphImage {
    image::Image<std::uint8_t> coverage;
    int left_px = 0, top_px = 0; ///< as in GlyphExtent
};

/// `setting` is one of `runs`, and `atlas` belongs to them.
[[nodiscard]] GlyphImage glyph_image(const pack::GlyphRuns& runs, const pack::DistanceAtlas& atlas,
                                     const pack::GlyphSetting& setting, double em_px);

} // namespace frustumscreen::typography
