/// A direction's linked cells as relief blocks.
///
/// Frames   the direction's grid, texels.
/// Threads  pure; any.
/// Source   layered depth images (Shade 1998), with their holes closed.
#pragma once

#include "app/relief/linked_cells.h"

#include <cstdint>
#include <vector>

namespace frustumscreen::relief {

/// Blocks, before they are added to a relief: as there, with `first_cover` an index into `covers` here.
struct DirectionBlocks {
    std::vector<ReliefBlock> blocks;
    std::vector<std::uint32_t> corner_codes;
    std::vector<std::uint64_t> covers;
    std::vector<glm::u8vec4> colours;

    void append(const DirectionBlocks& other);
};

/// Appends all layers at one block's position. `linker`: of `grid`.
void link_blocks(DirectionBlocks& into, CellLinker& linker, const GridCrossings& grid, int column0, int row0);

} // namespace frustumscreen::relief
