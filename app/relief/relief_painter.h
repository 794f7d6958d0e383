/// Paints a block relief into memory: the picture of its colours, and where each pixel's ray meets it.
///
/// Colour   sRGB codes of the artifact; a pixel's samples are averaged in linear light, and a sample that meets nothing counts as
///          black. Alpha is 255 where some sample meets the artifact, else 0. What the projector's light makes of them, a RowLight says.
/// Units    pixels from the picture's first; hits in the box frame.
/// Threads  `threads` in all, the caller's among them; one caller at a time. The result does not depend on their number.
/// Memory   kept from frame to frame: nothing is allocated once a picture as large and a view as full has been painted.
#pragma once

#include "app/relief/cast_blocks.h"
#include "app/relief/frame_workers.h"
#include "app/relief/picture_span.h"
#include "app/relief/sample_light.h"

#include <span>
#include <vector>

namespace frustumscreen {

/// Changes codes while they are at hand, before anybody sees them.
class RowLight {
public:
    virtual ~RowLight() = default;
    /// `codes`: of pixels of row `y`, from `first` on. Any thread, several at once.
    virtual void light(int y, int first, std::span<glm::u8vec4> codes) const = 0;
};

class ReliefPainter {
public:
    explicit ReliefPainter(int threads);

    /// What `view` shows of `relief`, with `samples` (1, 2, 4, 8 or 16) a pixel, in `light` or as it is. Writes every pixel of the
    /// rectangles that it returns, which lie one below the other, and none outside. They hold until the next call.
    std::span<const PixelRectangle> paint(const BlockRelief& relief, const CastView& view, int samples,
                                          const PictureSpan<glm::u8vec4>& picture,
                                          const RowLight* light = nullptr);

    /// For the same view the place of each pixel's first hit, box frame; NaN where there is none. Writes the whole picture.
    void hit_points(const BlockRelief& relief, const CastView& view, const PictureSpan<glm::vec3>& points);

private:
    void list(const BlockRelief& relief, const CastView& view);
    /// Of rows of `samples`, what may be lit.
    [[nodiscard]] static PixelRectangle lit_part(const CastSamples& samples, int top, int bottom);
    /// The pixels of a part of `samples`, as codes.
    void resolve(const CastSamples& samples, const BlockRelief& relief, const PixelRectangle& part,
                 const PictureSpan<glm::u8vec4>& picture, const RowLight* light) const;

    BlockItems items_;
    std::vector<CastSamples> samples_; ///< of a band at a time, one for each thread
    std::vector<PixelRectangle> painted_;
    SampleLight light_;
    FrameWorkers workers_; ///< last: its threads use the others
};

} // namespace frustumscreen
