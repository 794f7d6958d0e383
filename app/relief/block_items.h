/// The blocks that a frame rasterizes, and their pixels: culled by their gradients, projected through each
/// face's collineation, sorted front to back.
///
/// Frames   a direction's grid (block_relief.h), texels; pixels as in raster_view.h. The matrices are computed
///          in 64 bits, everything after them in 32.
/// Threads  pure; any.
/// SIMD     as rasterize_blocks.h; every instruction set makes equal lists.
#pragma once

#include "app/relief/block_relief.h"
#include "app/relief/instructions.h"
#include "app/relief/pixel_lens.h"
#include "app/relief/raster_view.h"

#include <array>
#include <cstdint>
#include <vector>

namespace frustumscreen::relief {

inline constexpr int rows_of_band = 64; ///< rows of pixels; small, so that the threads finish at about the
                                        ///< same time

/// Which side of the surface is seen. Away: the one that is turned away from the eye, as from inside an object.
enum class Facing : std::uint8_t { Eye, Away };

/// Maps one direction's grid to a face's pixels.
struct GridView {
    /// (x t, y t, t) from the grid's (u, v, w, 1): the ideal pixel that lights a point, and the length of its
    /// ray (raster_view.h).
    std::array<glm::vec4, 3> pixel{};
    glm::vec3 eye{0.0F};
};

/// Columns and rows of pixels, the last ones excluded.
struct PixelSpan {
    std::uint16_t left = 0, right = 0, top = 0, bottom = 0;
    [[nodiscard]] bool operator==(const PixelSpan&) const = default;
};

struct BlockItem {
    std::uint32_t block = 0;
    PixelSpan area; ///< the projector's pixels that may show a part of it
    std::uint8_t face = 0, direction = 0;
    bool inside = false; ///< far from all edges of the face, and wholly in front of the eye
    std::uint8_t bin = 0;
    float nearest = 0.0F; ///< upper bound of 1 / t along rays that hit it
    [[nodiscard]] bool operator==(const BlockItem&) const = default;
};

/// The lists keep their memory from frame to frame: nothing is allocated once they are large enough.
struct BlockItems {
    PixelLens lens;
    Facing facing = Facing::Eye;
    std::vector<std::array<GridView, 6>> grids; ///< [face][direction]
    std::vector<std::vector<BlockItem>> parts;  ///< of about a thousand blocks each
    std::vector<BlockItem> sorted;              ///< roughly front to back
    std::vector<std::uint32_t>
        banded; ///< indices into `sorted`: those whose area meets band 0, in their order, then band 1, ...
    std::vector<std::uint32_t> first_of_band; ///< start of each band in `banded`, and the end
};

/// Makes a list in three steps. `list_part` may run for several parts at once; `begin_list` sets their
/// number.
void begin_list(BlockItems& items, const BlockRelief& relief, const RasterView& view,
                Facing facing = Facing::Eye);
void list_part(BlockItems& items, const BlockRelief& relief, const RasterView& view, std::size_t part,
               Instructions instructions = best_instructions());
void end_list(BlockItems& items);

/// All three steps, for `relief` as seen in `view`.
void list_blocks(BlockItems& items, const BlockRelief& relief, const RasterView& view,
                 Instructions instructions = best_instructions(), Facing facing = Facing::Eye);

} // namespace frustumscreen::relief
