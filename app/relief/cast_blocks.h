/// The picture of a block relief: for each pixel the first block that its eye ray meets, where, and in which colour.
///
/// Shape    `CastPicture` is laid out in tiles of 4 x 2 pixels, a picture's rows of tiles one after another.
/// Units    t: of the pixel's ray (cast_view.h), infinite where nothing is met; place: 1 / 4096 of a cell.
/// Threads  rows of tiles are apart: `cast` may be called for several bands at once.
/// SIMD     eight lanes by the compiler's vectors; AVX2 where the processor has it, else what the compiler was told; the pictures
///          are equal, since nothing is contracted, approximated or summed in another order.
#pragma once

#include "app/relief/block_items.h"

#include <cstdint>
#include <vector>

namespace frustumscreen {

struct CastPicture {
    int columns = 0, rows = 0; ///< of tiles
    std::vector<float> t;
    std::vector<std::uint32_t> block;
    std::vector<std::uint32_t> place; ///< column in the lower half, row in the upper

    static constexpr std::uint32_t places_per_cell = 4096;

    void resize(int width, int height);
    [[nodiscard]] std::size_t at(int x, int y) const {
        return (static_cast<std::size_t>(y / tile_height) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(x / tile_width)) *
                   (tile_width * tile_height) +
               static_cast<std::size_t>(y % tile_height * tile_width + x % tile_width);
    }
};

/// Rows of tiles [first, end).
struct TileBand {
    int first = 0, end = 0;
};

/// Rays through any places of a band's tiles, by eights: those of a tile one after another, the last eight filled up with copies.
struct CastRays {
    TileBand band;
    int first_column = 0, columns = 0; ///< of tiles
    std::vector<std::uint32_t> first;  ///< eights before each tile, row by row; one more at the end
    std::vector<float> x, y;           ///< pixels
    std::vector<float> t;              ///< as in CastPicture, as the next two
    std::vector<std::uint32_t> block, place;

    /// No ray yet; keeps its memory.
    void begin(TileBand rows, int first_tile_column, int tile_columns);
    [[nodiscard]] std::size_t tile(int column, int row) const {
        return static_cast<std::size_t>(row - band.first) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column - first_column);
    }
};

/// Clears the band of the view's lit part, then casts into it.
void cast(CastPicture& picture, const BlockRelief& relief, const CastView& view, const BlockItems& items,
          TileBand band, Instructions instructions = Instructions::Best);

/// Clears what the rays have met, then casts them.
void cast(CastRays& rays, const BlockRelief& relief, const CastView& view, const BlockItems& items,
          Instructions instructions = Instructions::Best);

/// sRGB codes at a hit, bilinear between the corners.
[[nodiscard]] glm::u8vec4 colour_at(const BlockRelief& relief, std::uint32_t block, std::uint32_t place);

} // namespace frustumscreen
