/// Finds how far a surface reaches into a cell that it does not fill.
///
/// Method   9 x 9 lines a cell. The surface is followed from line to line, starting at the known corners and
///          at surface ends close to them. Unknown corners continue it: least squares over the crossings
///          found.
/// Frames   the direction's grid, texels.
/// Threads  pure; any.
#pragma once

#include "app/relief/grid_crossings.h"

#include <array>
#include <cstdint>
#include <vector>

namespace frustumscreen::relief {

/// The heights of a cell's corners (0, 0), (1, 0), (0, 1), (1, 1), some known.
struct CornerHeights {
    std::array<float, 4> w{}; ///< unknown ones are guesses
    std::array<bool, 4> known{};
};

/// Height of an end above the corners' bilinear surface, texels.
[[nodiscard]] float height_over(const CornerHeights& corners, const SheetEnd& end);
/// Ends within this distance belong to the surface, texels.
inline constexpr float end_reach = 0.3F;

/// Buffers that cutting keeps from cell to cell, so that it allocates little.
struct CutMemory {
    CellCrossings crossings;
    std::vector<glm::ivec2> front;
};

/// Bit 8 row + column: the surface reaches one of the corners of this part of the cell, or ends in it.
/// Refines the guesses.
[[nodiscard]] std::uint64_t cut_cell(const GridCrossings& grid, const CellLines& lines, int column, int row,
                                     CornerHeights& corners, CutMemory& memory);

} // namespace frustumscreen::relief
