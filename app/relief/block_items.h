/// Which blocks a frame casts, and where: culled by their gradients, projected through each face's collineation, sorted front to
/// back.
///
/// Frames   a direction's grid (block_relief.h), texels; pixels as in cast_view.h. 64-bit to the matrices, 32-bit from there on.
/// Threads  pure; any.
/// SIMD     as cast_blocks.h; the lists are equal.
#pragma once

#include "app/relief/block_relief.h"
#include "app/relief/cast_view.h"
#include "app/relief/instructions.h"
#include "app/relief/pixel_lens.h"

#include <array>
#include <cstdint>
#include <vector>

namespace frustumscreen {

inline constexpr int rows_of_band = 64; ///< of pixels: small enough that threads end together

/// A face's pixels as one direction's grid knows them.
struct GridView {
    /// (x t, y t, t) from the grid's (u, v, w, 1): the ideal pixel that lights a point, and the length of its ray (cast_view.h).
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
    PixelSpan area; ///< of the projector's pixels: may show some of it
    std::uint8_t face = 0, direction = 0;
    bool inside = false; ///< no edge of the face comes near, and all of it lies in front of the eye
    std::uint8_t bin = 0;
    float nearest = 0.0F; ///< no ray meets it at a greater 1 / t
    [[nodiscard]] bool operator==(const BlockItem&) const = default;
};

/// Lists are kept from frame to frame: nothing is allocated once they are large enough.
struct BlockItems {
    PixelLens lens;
    std::vector<std::array<GridView, 6>> grids; ///< [face][direction]
    std::vector<std::vector<BlockItem>> parts;  ///< of some thousand blocks each
    std::vector<BlockItem> sorted;              ///< front to back, roughly
    std::vector<std::uint32_t>
        banded; ///< of `sorted`: those whose area meets band 0, in their order, band 1, ...
    std::vector<std::uint32_t> first_of_band; ///< in `banded`; one more at the end
};

/// A list in three steps, of which the middle one may be made for several parts at once: as many as `begin_list` leaves.
void begin_list(BlockItems& items, const BlockRelief& relief, const CastView& view);
void list_part(BlockItems& items, const BlockRelief& relief, const CastView& view, std::size_t part,
               Instructions instructions = best_instructions());
void end_list(BlockItems& items);

/// All three: of `relief` as `view` shows it.
void list_blocks(BlockItems& items, const BlockRelief& relief, const CastView& view,
                 Instructions instructions = best_instructions());

} // namespace frustumscreen
