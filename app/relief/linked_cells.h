/// The cells of a crossed grid: four corners wherever the surface continues from crossing to crossing.
///
/// Frames   the direction's grid, texels.
/// Threads  a linker: one.
#pragma once

#include "app/relief/cut_cells.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::relief {

inline constexpr std::uint32_t no_crossing = 0xFFFFFFFFU;

/// Corners (0, 0), (1, 0), (0, 1), (1, 1) of the cell at (column, row). If a corner's line does not cross the
/// surface, its height is extrapolated from the others.
struct LinkedCell {
    std::array<std::uint32_t, 4> crossing{no_crossing, no_crossing, no_crossing,
                                          no_crossing}; ///< index into GridCrossings::crossings
    std::array<float, 4> w{};
    std::uint64_t cover = ~std::uint64_t{0}; ///< as BlockRelief::covers
    bool own = false;                        ///< no direction sees a part of it clearly better
    glm::u8vec4 colour{0};                   ///< for a cell without crossings; alpha 0: unused

    [[nodiscard]] bool whole() const {
        return std::find(crossing.begin(), crossing.end(), no_crossing) == crossing.end();
    }
};

class CellLinker {
public:
    /// `grid` and `lines` must outlive it.
    CellLinker(const GridCrossings& grid, const CellLines& lines) : grid_(grid), lines_(lines) {}

    /// All surfaces over one cell of which this direction owns at least one corner. A cell that lacks corners is
    /// cut where the surface ends; it may lack all four. Valid until the next call.
    [[nodiscard]] std::span<const LinkedCell> link(int column, int row);

private:
    const GridCrossings& grid_;
    const CellLines& lines_;
    std::vector<LinkedCell> cells_;
    std::vector<std::uint32_t> used_;
    CutMemory cut_;
};

} // namespace frustumscreen::relief
