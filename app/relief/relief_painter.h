/// Paints a block relief into memory: the picture of its colours, and where each pixel's ray meets it.
///
/// Colour   sRGB codes of the artifact, unlit by the projector; a pixel's samples are averaged in linear light, and a sample that
///          meets nothing counts as black. Alpha is 255 where some sample meets the artifact, else 0.
/// Units    pixels from the picture's first; hits in the box frame.
/// Threads  `threads` in all, the caller's among them; one caller at a time. The result does not depend on their number.
/// Memory   kept from frame to frame: nothing is allocated once a picture as large and a view as full has been painted.
#pragma once

#include "app/relief/cast_blocks.h"
#include "app/relief/fine_samples.h"
#include "app/relief/frame_workers.h"
#include "app/relief/picture_span.h"

#include <vector>

namespace frustumscreen {

class ReliefPainter {
public:
    explicit ReliefPainter(int threads);

    /// What `view` shows of `relief`. Writes every pixel of the rectangle that it returns and none outside: the view's lit part,
    /// rounded to tiles. `samples` (1, 2, 4, 8 or 16) a pixel where outlines or colours ask for them, one elsewhere.
    PixelRectangle paint(const BlockRelief& relief, const CastView& view, int samples,
                         const PictureSpan<glm::u8vec4>& picture);

    /// For the same view the place of each pixel's first hit, box frame; NaN where there is none. Writes the whole picture.
    void hit_points(const BlockRelief& relief, const CastView& view, const PictureSpan<glm::vec3>& points);

private:
    void cast_picture(const BlockRelief& relief, const CastView& view, int width, int height);
    [[nodiscard]] int bands() const;
    [[nodiscard]] TileBand band(int k) const;
    void shade(const BlockRelief& relief, const TileBand& band);
    void copy(const TileBand& band, const PictureSpan<glm::u8vec4>& picture);

    BlockItems items_;
    CastPicture cast_;
    int first_row_ = 0, end_row_ = 0; ///< of tiles, that the view lights
    LitCodes codes_;
    SampleLight light_;
    std::vector<FineBand> fine_; ///< one for each band
    FrameWorkers workers_;       ///< last: its threads use the others
};

} // namespace frustumscreen
