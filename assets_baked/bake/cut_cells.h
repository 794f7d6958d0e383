/// How far a surface reaches into a cell that it does not fill.
///
/// Method   9 x 9 lines a cell; from the corners that are known, and from the surface's ends that lie where these let it be, it is
///          followed from line to line. Corners that are not known continue it: least squares over what was found.
/// Frames   the direction's grid, texels.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/grid_crossings.h"

#include <array>
#include <cstdint>

namespace frustumscreen {

/// The heights of a cell's corners (0, 0), (1, 0), (0, 1), (1, 1), some known.
struct CornerHeights {
    std::array<float, 4> w{}; ///< of those that are not known, a guess
    std::array<bool, 4> known{};
};

/// How far above the corners' bilinear surface an end lies: texels.
[[nodiscard]] float height_over(const CornerHeights& corners, const SheetEnd& end);
/// Ends no farther from it are its own: texels.
inline constexpr float end_reach = 0.3F;

/// Bit 8 row + column: the surface reaches one of the corners of this part of the cell, or ends in it. Mends the guesses.
[[nodiscard]] std::uint64_t cut_cell(const BlockInput& input, const GridCrossings& grid, int column, int row,
                                     CornerHeights& corners);

} // namespace frustumscreen
