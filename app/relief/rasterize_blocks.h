/// Rasterizes block reliefs for the eye: for each sample of each pixel the nearest block that its ray hits,
/// the position in it, and the nearness. Reliefs rasterized into the same samples, for one eye, hide each other.
///
/// Units    nearness: 1 / t of the pixel's ray (raster_view.h), 0 without a hit; position (`place`): 1 / 4096
///          of a cell, column in the lower half, row in the upper.
/// Threads  each call has its own samples: `rasterize` may run for several rectangles at once.
/// SIMD     eight lanes by the compiler's vectors, for each of instructions.h. All make equal pictures, since
///          nothing is contracted, approximated or summed in another order.
#pragma once

#include "app/relief/block_items.h"
#include "app/relief/dither.h"
#include "firmware_host/base/pixel_rectangle.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace frustumscreen::relief {

/// The samples of a rectangle of pixels, row by row: first the first sample of each pixel of the row, then
/// the second ones, and so on, so that samples of neighbouring pixels are adjacent. `lanes` elements after
/// the end may be read.
class RasterSamples {
public:
    static constexpr std::uint32_t places_per_cell = 4096;
    static constexpr std::uint32_t most = 16; ///< a pixel

    /// Reserves memory: a later `begin` that needs no more allocates nothing.
    void make_space(int width, int height, int count);
    /// Resets to `count` samples a pixel, a power of two, without hits. Keeps its memory.
    void begin(const PixelRectangle& pixels, int count);

    [[nodiscard]] const PixelRectangle& pixels() const { return pixels_; }
    /// The samples' positions from each pixel's corner: a single one is at the centre; several have a column
    /// and a row each.
    [[nodiscard]] const std::vector<glm::vec2>& places() const { return places_; }
    /// Index of a pixel's sample `k`.
    [[nodiscard]] std::size_t at(int x, int y, std::size_t k = 0) const {
        return (static_cast<std::size_t>(y - pixels_.y) * places_.size() + k) *
                   static_cast<std::size_t>(pixels_.width) +
               static_cast<std::size_t>(x - pixels_.x);
    }
    /// Columns of a row that may have hits, the last one excluded.
    struct Extent {
        int first = 0, end = 0;
    };
    [[nodiscard]] const Extent& extent(int y) const {
        return extents_[static_cast<std::size_t>(y - pixels_.y)];
    }
    void widen(int y, const Extent& by) {
        Extent& extent = extents_[static_cast<std::size_t>(y - pixels_.y)];
        extent = {std::min(extent.first, by.first), std::max(extent.end, by.end)};
    }

    std::vector<float> nearness;
    std::vector<std::uint32_t> block, place; ///< valid where there is a hit

private:
    PixelRectangle pixels_;
    std::vector<glm::vec2> places_;
    std::vector<Extent> extents_; ///< per row
};

/// How a relief takes part in its samples.
struct RasterShare {
    std::uint32_t first_block = 0;               ///< number of its first block in `RasterSamples::block`
    std::optional<Dither> dither = std::nullopt; ///< nullopt: it takes every pixel
};

/// Rasterizes `items` into the samples.
void rasterize(RasterSamples& samples, const BlockRelief& relief, const RasterView& view,
               const BlockItems& items, const RasterShare& share = {},
               Instructions instructions = best_instructions());

/// sRGB codes at a hit, bilinear between the corners.
[[nodiscard]] glm::u8vec4 colour_at(const BlockRelief& relief, std::uint32_t block, std::uint32_t place);

} // namespace frustumscreen::relief
