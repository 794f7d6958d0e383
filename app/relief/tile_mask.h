/// A set of tiles of a picture: those whose pixels the caller needs.
///
/// Units    tiles of 8 x 8 pixels of a picture of at most 512 x 512, counted from its first pixel.
/// Threads  values; any.
#pragma once

#include "firmware_host/base/pixel_rectangle.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <functional>

namespace frustumscreen::relief {

class TileMask {
public:
    static constexpr int tile_px = 8;
    static constexpr int max_px = 512;

    void clear() { rows_.fill(0); }
    /// Asks for the tiles that a rectangle of the picture meets.
    void ask(const PixelRectangle& part) {
        if (part.empty()) {
            return;
        }
        const std::uint64_t columns = columns_of(part);
        for (int row = part.y / tile_px; row <= (part.y + part.height - 1) / tile_px; ++row) {
            rows_[static_cast<std::size_t>(row)] |= columns;
        }
    }
    void ask(const TileMask& other) {
        std::transform(rows_.begin(), rows_.end(), other.rows_.begin(), rows_.begin(), std::bit_or<>());
    }
    /// True if some tile, or each, that the rectangle meets is asked for; it has pixels, all of them in the picture.
    [[nodiscard]] bool some(const PixelRectangle& part) const {
        std::uint64_t asked = 0;
        for (int row = part.y / tile_px; row <= (part.y + part.height - 1) / tile_px; ++row) {
            asked |= rows_[static_cast<std::size_t>(row)];
        }
        return (asked & columns_of(part)) != 0;
    }
    [[nodiscard]] bool each(const PixelRectangle& part) const {
        std::uint64_t asked = ~std::uint64_t{0};
        for (int row = part.y / tile_px; row <= (part.y + part.height - 1) / tile_px; ++row) {
            asked &= rows_[static_cast<std::size_t>(row)];
        }
        return (~asked & columns_of(part)) == 0;
    }
    /// Bit k: the tile of columns 8 k to 8 k + 7, in the tiles' row of pixel row `y`.
    [[nodiscard]] std::uint64_t tiles_at(int y) const { return rows_[static_cast<std::size_t>(y / tile_px)]; }
    /// Around the asked tiles.
    [[nodiscard]] PixelRectangle bounds() const {
        PixelRectangle around;
        for (int row = 0; row < max_px / tile_px; ++row) {
            if (const std::uint64_t tiles = rows_[static_cast<std::size_t>(row)]; tiles != 0) {
                const int first = std::countr_zero(tiles);
                around = united(around, {.x = first * tile_px,
                                         .y = row * tile_px,
                                         .width = (64 - std::countl_zero(tiles) - first) * tile_px,
                                         .height = tile_px});
            }
        }
        return around;
    }

private:
    static std::uint64_t columns_of(const PixelRectangle& part) {
        assert(part.x >= 0 && part.width > 0 && part.x + part.width <= max_px);
        const int first = part.x / tile_px;
        const int count = (part.x + part.width - 1) / tile_px - first + 1;
        return ~std::uint64_t{0} >> (64 - count) << first;
    }
    static_assert(max_px / tile_px == 64);
    std::array<std::uint64_t, 64> rows_{};
};

} // namespace frustumscreen::relief
