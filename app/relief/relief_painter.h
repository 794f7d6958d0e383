/// Rasterizes block reliefs into memory: one picture of their colours, where the nearest is visible however their boxes
/// interlock, or the hit point of each pixel's ray.
///
/// Colour   sRGB codes of the artifact; a pixel's samples are averaged in linear light, and a sample without
///          a hit counts as black. Alpha is 255 where some sample hits the artifact, otherwise 0. A RowLight
///          applies the projector's light.
/// Depth    in the rectangles of a DepthPicture a pixel is the mean of its hits alone, and alpha is their share of its
///          samples, so that the picture can be laid before and behind others.
/// Units    pixels from the picture's first; hits in the box frame.
/// Threads  `threads` in all, including the caller's; one caller at a time. The result does not depend on
///          their number.
/// Memory   kept from frame to frame: nothing is allocated once a picture as large and a view as full has
///          been painted.
#pragma once

#include "app/relief/block_pages.h"
#include "app/relief/frame_workers.h"
#include "app/relief/nearness_row.h"
#include "app/relief/picture_span.h"
#include "app/relief/rasterize_blocks.h"
#include "app/relief/resolve_row.h"
#include "app/relief/sample_light.h"
#include "app/relief/tile_mask.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::relief {

/// Changes a row's codes right after they are computed.
class RowLight {
public:
    virtual ~RowLight() = default;
    /// `codes`: of row `y`, from pixel `first` on. Called from any thread, several at once.
    virtual void light(int y, int first, std::span<glm::u8vec4> codes) const = 0;
};

/// A relief of a picture, and how the picture's eye sees it.
struct SeenRelief {
    const BlockRelief* relief = nullptr;
    const RasterView* view = nullptr;
    std::optional<Dither> dither = std::nullopt; ///< nullopt: every pixel
    glm::vec3 light{1.0F};                       ///< 0..1, linear: factor of its colours
    /// Other colours, in the order of its own, for DepthPicture::layer; null: its own.
    const std::vector<glm::u8vec4>* layer = nullptr;
    Facing facing = Facing::Eye;
};

/// Where something else may hide a relief, or a relief hide it.
struct DepthPicture {
    std::span<const PixelRectangle> parts;
    PictureSpan<float> nearness; ///< as nearness_row.h
    /// Where something is laid over the picture by its depth: there `nearness` is written too, and `layer`, if there is one: each
    /// pixel's mean of its hits in the reliefs' other colours, unlit.
    std::span<const PixelRectangle> overlaid = {};
    PictureSpan<glm::u8vec4> layer = {};
};
/// The part of a painted rectangle that has depth: all its rows, between the outermost columns of `parts` in it.
[[nodiscard]] PixelRectangle depth_part(const PixelRectangle& painted, std::span<const PixelRectangle> parts);

class ReliefPainter {
public:
    explicit ReliefPainter(int threads);

    /// Paints the reliefs as seen in their views, which are of one frame, with `samples` (1, 2, 4, 8 or 16) a pixel, in
    /// `light` or unlit. Writes every pixel of the returned rectangles, which lie one below the other, and none outside;
    /// of `depth`, the `depth_part` of each. They are valid until the next call.
    std::span<const PixelRectangle> paint(std::span<const SeenRelief> reliefs, int samples,
                                          const PictureSpan<glm::u8vec4>& picture,
                                          const RowLight* light = nullptr, const DepthPicture& depth = {});

    /// As above, for one relief.
    std::span<const PixelRectangle> paint(const BlockRelief& relief, const RasterView& view, int samples,
                                          const PictureSpan<glm::u8vec4>& picture,
                                          const RowLight* light = nullptr) {
        const SeenRelief seen{.relief = &relief, .view = &view};
        return paint(std::span(&seen, 1), samples, picture, light);
    }

    /// The nearness alone (nearness_row.h) at the centres of the pixels in the asked tiles, which must be 0 before; in other tiles it
    /// is unspecified. For a plain pinhole and views of one face, the same one, around the whole picture.
    void paint_nearness(std::span<const SeenRelief> reliefs, const TileMask& asked,
                        const PictureSpan<float>& nearness);

    /// The position of each pixel's first hit, box frame; NaN without a hit. Writes the whole picture.
    void hit_points(const SeenRelief& seen, const PictureSpan<glm::vec3>& points);
    void hit_points(const BlockRelief& relief, const RasterView& view, const PictureSpan<glm::vec3>& points) {
        hit_points(SeenRelief{.relief = &relief, .view = &view}, points);
    }

private:
    /// A relief of the picture that is being painted.
    struct Listed {
        SeenRelief seen;
        RasterShare share;
        float nearest = 0.0F;
        BlockItems items;
    };
    struct Picture {
        const PictureSpan<glm::u8vec4>& codes;
        const RowLight* light = nullptr;
        const DepthPicture& depth;
    };

    void list(std::span<const SeenRelief> reliefs);
    void list_blocks_of_all();
    /// The part of these rows of `samples` that may be lit.
    [[nodiscard]] static PixelRectangle lit_part(const RasterSamples& samples, int top, int bottom);
    /// Writes the pixels of a part of `samples`, as codes.
    void resolve(const RasterSamples& samples, const PixelRectangle& part, const Picture& picture) const;
    /// Some columns of row `y`.
    void resolve_columns(const RasterSamples& samples, int y, const RasterSamples::Extent& columns,
                         Outline outline, const Picture& picture) const;

    std::vector<Listed> listed_; ///< the first `count_` are of this picture
    std::size_t count_ = 0;
    std::vector<std::size_t> order_; ///< of these, roughly front to back
    BlockPages pages_, layer_pages_;
    NearnessView nearness_;
    std::vector<RasterSamples> samples_; ///< one per thread, each for one band at a time
    std::vector<PixelRectangle> painted_;
    SampleLight light_;
    FrameWorkers workers_; ///< last: its threads use the other members
};

} // namespace frustumscreen::relief
