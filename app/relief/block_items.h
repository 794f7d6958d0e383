/// Which blocks a frame casts, and where: culled by their gradients, projected through each face's collineation, sorted front to
/// back.
///
/// Tiles    4 x 2 pixels; a picture has ceil(width / 4) x ceil(height / 2) of them.
/// Frames   a direction's grid (block_relief.h), texels; pixels as in cast_view.h. 64-bit to the matrices, 32-bit from there on.
/// Threads  pure; any.
/// SIMD     as cast_blocks.h; the lists are equal.
#pragma once

#include "app/relief/block_relief.h"
#include "app/relief/cast_view.h"

#include <array>
#include <cstdint>
#include <vector>

namespace frustumscreen {

inline constexpr int tile_width = 4;
inline constexpr int tile_height = 2;
inline constexpr int rows_of_band = 8; ///< of tiles: small enough that threads end together

/// A face's rays and pixels in one direction's grid.
struct GridView {
    std::array<glm::vec3, 3> ray{};   ///< (u, v, w) of the ray, each from the pixel (x, y, 1)
    std::array<glm::vec4, 3> pixel{}; ///< (x w, y w, w) from the grid's (u, v, w, 1)
    glm::vec3 eye{0.0F};
};

/// How a ray's meeting with a block's surface is found.
enum class Search : std::uint8_t {
    Newton1, ///< this many steps from where the ray meets the block's plane
    Newton2,
    Newton3,
    March ///< some cells may face away: from the front of the block's slab to its back
};

/// Columns and rows of tiles, the last ones excluded.
struct TileRectangle {
    std::uint16_t first_column = 0, end_column = 0, first_row = 0, end_row = 0;
    [[nodiscard]] bool operator==(const TileRectangle&) const = default;
};

struct BlockItem {
    std::uint32_t block = 0;
    TileRectangle
        centres; ///< may have a pixel's centre in the block; empty where the block lies between centres
    TileRectangle area; ///< may have any part of it
    std::uint8_t face = 0, direction = 0;
    Search search = Search::Newton1;
    bool inside = false; ///< no edge of the face comes near
    std::uint8_t bin = 0;
    float reach = 0.0F; ///< cells by which a ray may stray in the block between its plane and its surface
    float early = 0.0F; ///< share of the way to its plane by which a ray may meet its surface before
    [[nodiscard]] bool operator==(const BlockItem&) const = default;
};

/// Lists are kept from frame to frame: nothing is allocated once they are large enough.
struct BlockItems {
    std::vector<std::array<GridView, 6>> grids; ///< [face][direction]
    std::vector<std::vector<BlockItem>> parts;  ///< of some thousand blocks each
    std::vector<BlockItem> sorted;              ///< front to back, roughly
    std::vector<std::uint32_t>
        banded; ///< of `sorted`: those whose area meets band 0, in their order, band 1, ...
    std::vector<std::uint32_t> first_of_band; ///< in `banded`; one more at the end
};

/// The widest that the processor has, or what any of our processors has.
enum class Instructions : std::uint8_t { Best, Plain };

/// A list in three steps, of which the middle one may be made for several parts at once: as many as `begin_list` leaves.
void begin_list(BlockItems& items, const BlockRelief& relief, const CastView& view);
void list_part(BlockItems& items, const BlockRelief& relief, const CastView& view, std::size_t part,
               Instructions instructions = Instructions::Best);
void end_list(BlockItems& items);

/// All three: of `relief` as `view` shows it.
void list_blocks(BlockItems& items, const BlockRelief& relief, const CastView& view,
                 Instructions instructions = Instructions::Best);

} // namespace frustumscreen
