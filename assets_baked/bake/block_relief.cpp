#include "assets_baked/bake/block_relief.h"

#include "app/relief/linked_blocks.h"
#include "assets_baked/bake/cross_grid.h"
#include "firmware_host/base/parallel.h"

#include <utility>

namespace frustumscreen::bake {

namespace {

relief::DirectionBlocks blocks_of(const BlockInput& input, const relief::GridCrossings& grid) {
    const SceneLines lines(input, grid.grid);
    std::vector<relief::DirectionBlocks> rows(
        static_cast<std::size_t>((grid.rows - 1) / relief::block_cells));
    parallel_for(rows.size(), 1, [&](std::size_t begin, std::size_t end) {
        relief::CellLinker linker(grid, lines);
        for (std::size_t k = begin; k < end; ++k) {
            const int row = static_cast<int>(k) * relief::block_cells;
            for (int column = 0; column + relief::block_cells < grid.columns; column += relief::block_cells) {
                relief::link_blocks(rows[k], linker, grid, column, row);
            }
        }
    });
    relief::DirectionBlocks all;
    for (const relief::DirectionBlocks& row : rows) {
        all.append(row);
    }
    return all;
}

} // namespace

relief::BlockRelief bake_blocks(const BlockInput& input) {
    relief::BlockRelief relief;
    relief.texel_box = static_cast<float>(1.0 / input.texels);
    relief::DirectionBlocks all;
    for (const pack::ReliefDirection direction : input.directions) {
        const relief::GridCrossings grid = cross_grid(input, direction);
        relief.grids.push_back(grid.grid);
        relief.first_block.push_back(static_cast<std::uint32_t>(all.blocks.size()));
        all.append(blocks_of(input, grid));
    }
    relief.first_block.push_back(static_cast<std::uint32_t>(all.blocks.size()));
    relief.blocks = std::move(all.blocks);
    relief.corner_codes = std::move(all.corner_codes);
    relief.covers = std::move(all.covers);
    relief.colours = std::move(all.colours);
    return relief;
}

} // namespace frustumscreen::bake
