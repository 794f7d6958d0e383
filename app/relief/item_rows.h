/// The items of a list (block_items.h) one by one, with their rows of cells: what both rasterizers walk over.
///
/// Threads  pure; any. Inlined into one function for each instruction set of rasterize_blocks.cpp and
///          rasterize_nearness.cpp; a test counts steps with it.
#pragma once

#include "app/relief/cell_row.h"
#include "app/relief/lens_lanes.h"
#include "app/relief/rasterize_blocks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>

namespace frustumscreen::relief {

/// An item with everything that its rows of cells need.
struct ReadyItem {
    const BlockItem& item;
    const ReliefBlock& block;
    const std::uint32_t* codes;
    const std::uint64_t* covers;
    const PixelLens& lens;
    std::array<glm::vec3, 4> edges; ///< the face's first ones
    std::span<const glm::dvec3> more_edges;
    CornerMap map;
    float outward;        ///< sign of the picture area of a cell whose seen side faces the eye
    std::uint32_t number; ///< of the block, in the samples
    const Dither* dither; ///< used if the rasterization dithers
};

FRUSTUMSCREEN_INLINE ReadyItem ready(const BlockRelief& relief, const RasterView& view,
                                     const BlockItems& items, const BlockItem& item,
                                     const RasterShare& share) {
    const ReliefBlock& block = relief.blocks[item.block];
    const GridView& grid = items.grids[item.face][item.direction];
    const RasterFace& face = view.faces[item.face];
    const float turn =
        glm::dot(glm::vec3(grid.pixel[0]), glm::cross(glm::vec3(grid.pixel[1]), glm::vec3(grid.pixel[2])));
    return {.item = item,
            .block = block,
            .codes = &relief.corner_codes[std::size_t{item.block} * block_cells * block_cells],
            .covers = relief.covers.data() + block.first_cover,
            .lens = items.lens,
            .edges = first_edges(face),
            .more_edges = more_edges(face),
            .map = corner_map(block, grid),
            .outward = (turn > 0.0F) == (items.facing == Facing::Eye) ? -1.0F : 1.0F,
            .number = share.first_block + item.block,
            .dither = share.dither ? &*share.dither : nullptr};
}

/// True if the surface exists at this position of the block.
FRUSTUMSCREEN_INLINE bool is_covered(const ReadyItem& ready, std::uint32_t place) {
    constexpr std::uint32_t unit = RasterSamples::places_per_cell;
    const std::uint32_t u = place & 0xFFFFU;
    const std::uint32_t v = place >> 16U;
    const std::uint64_t bit = std::uint64_t{1} << (v / unit * block_cells + u / unit);
    if ((ready.block.cut & bit) == 0) {
        return true;
    }
    const std::uint64_t cover = ready.covers[std::popcount(ready.block.cut & (bit - 1))];
    return (cover >> (v % unit / (unit / 8) * 8 + u % unit / (unit / 8)) & 1U) != 0;
}

/// Calls meet(corners, which cells, row) for each row of the item's cells.
template <typename Meet> FRUSTUMSCREEN_INLINE void for_each_row(const ReadyItem& ready, const Meet& meet) {
    constexpr Floats columns = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F};
    constexpr Ints lane_bits = {1, 2, 4, 8, 16, 32, 64, 128};
    CellCorners at{};
    bool known = false; // the previous row has computed this row's corners
    for (int row = ready.block.cells[2]; row < ready.block.cells[3]; ++row) {
        const auto here = static_cast<std::int32_t>(ready.block.mask >> (row * block_cells) & 255U);
        if (here == 0) {
            known = false;
            continue;
        }
        Ints codes;
        std::memcpy(&codes, ready.codes + row * block_cells, sizeof codes);
        const auto corners = [&](int column, int up, int shift) FRUSTUMSCREEN_INLINED {
            Corners ideal =
                corners_at(ready.map, columns + static_cast<float>(column), row + up, codes >> shift & 255);
            if (ready.lens.bends) {
                const PixelLanes lit = bent(ready.lens, {ideal.x, ideal.y});
                ideal.x = lit.x;
                ideal.y = lit.y;
            }
            return ideal;
        };
        at.a = known ? at.c : corners(0, 0, 0);
        at.b = known ? at.d : corners(1, 0, 8);
        at.c = corners(0, 1, 16);
        at.d = corners(1, 1, 24);
        known = true;
        Ints cells = (here & lane_bits) != 0;
        if (!ready.item.inside) {
            cells &= (at.a.nearness > 0.0F) & (at.b.nearness > 0.0F) & (at.c.nearness > 0.0F) &
                     (at.d.nearness > 0.0F);
        }
        meet(at, cells, row);
    }
}

/// The part of the item's area that lies in the band's rows, and in the columns that are painted.
FRUSTUMSCREEN_INLINE PixelSpan within(const PixelSpan& area, const PixelRectangle& pixels, int k) {
    const int first = std::max(pixels.y, k * rows_of_band);
    const int end = std::min(pixels.y + pixels.height, (k + 1) * rows_of_band);
    PixelSpan span = area;
    span.left = static_cast<std::uint16_t>(std::max<int>(area.left, pixels.x));
    span.right = static_cast<std::uint16_t>(std::min<int>(area.right, pixels.x + pixels.width));
    span.top = static_cast<std::uint16_t>(std::max<int>(area.top, first));
    span.bottom = static_cast<std::uint16_t>(std::min<int>(area.bottom, end));
    return span;
}

/// The list's items that may meet band `k`, front to back.
inline std::span<const std::uint32_t> items_of(const BlockItems& items, int k) {
    const auto band = static_cast<std::size_t>(k);
    if (band + 1 >= items.first_of_band.size()) {
        return {};
    }
    const std::span<const std::uint32_t> all_of(items.banded);
    return all_of.subspan(items.first_of_band[band],
                          items.first_of_band[band + 1] - items.first_of_band[band]);
}

} // namespace frustumscreen::relief
