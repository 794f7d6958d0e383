/// Paints a block relief into memory: the picture of its colours, and where each pixel's ray meets it.
///
/// Colour   sRGB codes of the artifact, unlit by the projector; a pixel's samples are averaged in linear light, and a sample that
///          meets nothing counts as black. Alpha is 255 where some sample meets the artifact, else 0.
/// Units    pixels from the picture's first; hits in the box frame.
/// Threads  `threads` in all, the caller's among them; one caller at a time. The result does not depend on their number.
/// Memory   kept from frame to frame: nothing is allocated once a picture as large and a view as full has been painted.
#pragma once

#include "app/relief/cast_blocks.h"
#include "app/relief/frame_workers.h"
#include "app/relief/picture_span.h"
#include "app/relief/sample_light.h"

#include <vector>

namespace frustumscreen {

class ReliefPainter {
public:
    explicit ReliefPainter(int threads);

    /// What `view` shows of `relief`. Writes every pixel of the rectangle that it returns and none outside: the view's lit part.
    /// `samples` (1, 2, 4, 8 or 16) a pixel.
    PixelRectangle paint(const BlockRelief& relief, const CastView& view, int samples,
                         const PictureSpan<glm::u8vec4>& picture);

    /// For the same view the place of each pixel's first hit, box frame; NaN where there is none. Writes the whole picture.
    void hit_points(const BlockRelief& relief, const CastView& view, const PictureSpan<glm::vec3>& points);

private:
    void list(const BlockRelief& relief, const CastView& view);
    /// The pixels of `samples`, as codes.
    void resolve(const CastSamples& samples, const BlockRelief& relief,
                 const PictureSpan<glm::u8vec4>& picture) const;
    [[nodiscard]] glm::u8vec4 code_at(const CastSamples& samples, std::size_t first,
                                      const BlockRelief& relief) const;

    BlockItems items_;
    std::vector<CastSamples> samples_; ///< of a band at a time, one for each thread
    SampleLight light_;
    FrameWorkers workers_; ///< last: its threads use the others
};

} // namespace frustumscreen
