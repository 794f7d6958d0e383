/// The part of the picture that an artifact may light, as rectangles of whole tiles.
///
/// Besides its triangles a picture costs clearing and averaging, and a thin artifact lights only a small part
/// of the rectangle around it.
///
/// Units    pixels, row 0 at the top.
/// Threads  values; any. Allocates nothing.
#pragma once

#include "firmware_host/base/pixel_rectangle.h"

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>

namespace frustumscreen::scene {

class LitTiles {
public:
    static constexpr std::size_t max_rectangles = 96;

    /// Begins a picture without lit tiles.
    void begin(int picture_width, int picture_height);
    void light(const PixelRectangle& part);
    /// Makes the rectangles from what was lit: disjoint, inside the picture.
    void finish();

    [[nodiscard]] std::span<const PixelRectangle> rectangles() const {
        return std::span(rectangles_).first(count_);
    }
    /// The number of pixels in the rectangles.
    [[nodiscard]] std::int64_t pixels() const;
    /// Size of the picture.
    [[nodiscard]] PixelSize picture() const { return {width_, height_}; }
    /// The rectangle around everything lit.
    [[nodiscard]] PixelRectangle bounds() const { return bounds_; }

private:
    static constexpr int max_tiles = 256; ///< along a side
    using Row = std::bitset<max_tiles>;

    [[nodiscard]] bool add(const PixelRectangle& rectangle);

    int tile_ = 16;
    int width_ = 0, height_ = 0;
    PixelRectangle bounds_;
    std::array<Row, max_tiles> rows_{};
    std::array<PixelRectangle, max_rectangles> rectangles_{};
    std::size_t count_ = 0;
};

} // namespace frustumscreen::scene
