/// Rasterizes a block relief into memory: the picture of its colours, or the hit point of each pixel's ray.
///
/// Colour   sRGB codes of the artifact; a pixel's samples are averaged in linear light, and a sample without
///          a hit counts as black. Alpha is 255 where some sample hits the artifact, otherwise 0. A RowLight
///          applies the projector's light.
/// Units    pixels from the picture's first; hits in the box frame.
/// Threads  `threads` in all, including the caller's; one caller at a time. The result does not depend on
///          their number.
/// Memory   kept from frame to frame: nothing is allocated once a picture as large and a view as full has
///          been painted.
#pragma once

#include "app/relief/frame_workers.h"
#include "app/relief/rasterize_blocks.h"
#include "app/relief/sample_light.h"

#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen::relief {

/// A view of texels in memory that it does not own: row 0 at the top, `stride` texels from row to row.
template <typename Texel> struct PictureSpan {
    Texel* first = nullptr;
    int width = 0, height = 0;
    std::ptrdiff_t stride = 0;

    [[nodiscard]] Texel& at(int x, int y) const { return first[y * stride + x]; }
};

/// Changes a row's codes right after they are computed.
class RowLight {
public:
    virtual ~RowLight() = default;
    /// `codes`: of row `y`, from pixel `first` on. Called from any thread, several at once.
    virtual void light(int y, int first, std::span<glm::u8vec4> codes) const = 0;
};

class ReliefPainter {
public:
    explicit ReliefPainter(int threads);

    /// Paints `relief` as seen in `view`, with `samples` (1, 2, 4, 8 or 16) a pixel, in `light` or unlit.
    /// Writes every pixel of the returned rectangles, which lie one below the other, and none outside. They
    /// are valid until the next call.
    std::span<const PixelRectangle> paint(const BlockRelief& relief, const RasterView& view, int samples,
                                          const PictureSpan<glm::u8vec4>& picture,
                                          const RowLight* light = nullptr);

    /// The position of each pixel's first hit, box frame; NaN without a hit. Writes the whole picture.
    void hit_points(const BlockRelief& relief, const RasterView& view, const PictureSpan<glm::vec3>& points);

private:
    void list(const BlockRelief& relief, const RasterView& view);
    /// The part of these rows of `samples` that may be lit.
    [[nodiscard]] static PixelRectangle lit_part(const RasterSamples& samples, int top, int bottom);
    /// Writes the pixels of a part of `samples`, as codes.
    void resolve(const RasterSamples& samples, const BlockRelief& relief, const PixelRectangle& part,
                 const PictureSpan<glm::u8vec4>& picture, const RowLight* light) const;

    BlockItems items_;
    std::vector<RasterSamples> samples_; ///< one per thread, each for one band at a time
    std::vector<PixelRectangle> painted_;
    SampleLight light_;
    FrameWorkers workers_; ///< last: its threads use the other members
};

} // namespace frustumscreen::relief
