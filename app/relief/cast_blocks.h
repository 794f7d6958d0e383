/// A block relief as the eye sees it: for each sample of each pixel the nearest block that its ray meets, where, and how near.
///
/// Units    nearness: 1 / t of the pixel's ray (cast_view.h), 0 where nothing is met; place: 1 / 4096 of a cell, column in the
///          lower half, row in the upper.
/// Threads  the samples of one call are its own: `cast` may be called for several rectangles at once.
/// SIMD     eight lanes by the compiler's vectors, for each of instructions.h; the pictures are equal, since nothing is contracted,
///          approximated or summed in another order.
#pragma once

#include "app/relief/block_items.h"
#include "firmware_host/base/pixel_rectangle.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen {

/// The samples of a rectangle of pixels, row by row: first those of all of a row's pixels that are their first, then the second ones,
/// and so on, so that neighbours' lie side by side. Behind the last, `lanes` more may be read.
class CastSamples {
public:
    static constexpr std::uint32_t places_per_cell = 4096;
    static constexpr std::uint32_t most = 16; ///< of a pixel

    /// For so many pixels of so many samples: what is begun after it and is no larger allocates nothing.
    void make_room(int width, int height, int count);
    /// Of `count` samples a pixel, a power of two; nothing is met. Keeps its memory.
    void begin(const PixelRectangle& pixels, int count);

    [[nodiscard]] const PixelRectangle& pixels() const { return pixels_; }
    /// Of each pixel, from its corner: one is at its centre; of more each has a column and a row of its own.
    [[nodiscard]] const std::vector<glm::vec2>& places() const { return places_; }
    /// A pixel's sample `k`.
    [[nodiscard]] std::size_t at(int x, int y, std::size_t k = 0) const {
        return (static_cast<std::size_t>(y - pixels_.y) * places_.size() + k) *
                   static_cast<std::size_t>(pixels_.width) +
               static_cast<std::size_t>(x - pixels_.x);
    }
    /// Columns of a row that may have met something, the last one excluded.
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
    std::vector<std::uint32_t> block, place; ///< where something is met

private:
    PixelRectangle pixels_;
    std::vector<glm::vec2> places_;
    std::vector<Extent> extents_; ///< of the rows
};

/// Adds what `items` show in the samples' pixels.
void cast(CastSamples& samples, const BlockRelief& relief, const CastView& view, const BlockItems& items,
          Instructions instructions = best_instructions());

/// sRGB codes at a hit, bilinear between the corners.
[[nodiscard]] glm::u8vec4 colour_at(const BlockRelief& relief, std::uint32_t block, std::uint32_t place);

} // namespace frustumscreen
