/// The points where the lines of a direction's grid cross a surface from its front, and those of lines between them.
///
/// Frames   the direction's grid (block_relief.h), texels.
/// Threads  values; any.
#pragma once

#include "app/relief/block_relief.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace frustumscreen::relief {

/// A line's crossing of the surface from its front, not at too flat an angle; texels.
struct LineCrossing {
    float w = 0.0F;
    float slope_u = 0.0F, slope_v = 0.0F; ///< change of w per texel
};

/// True if slopes along one direction, on either side of an edge between them, belong to two faces: one
/// bilinear surface across both could cut more than a quarter of a texel off the edge. (At half of it a bust
/// of 70,000 triangles needs a third more blocks.)
[[nodiscard]] inline bool is_crease(float slope, float other) {
    const float mean = 0.5F * (slope + other);
    return std::abs(slope - other) > std::sqrt(1.0F + mean * mean);
}

struct Crossing : LineCrossing {
    bool own = false; ///< this direction draws the surface here: no other one sees it clearly better
    glm::u8vec4 colour{0};
};

/// A point near an edge of the surface that the direction sees.
struct SheetEnd : Crossing {
    float u = 0.0F, v = 0.0F;

    /// (row, column).
    [[nodiscard]] std::pair<int, int> cell() const {
        return {static_cast<int>(std::floor(v)), static_cast<int>(std::floor(u))};
    }
};

/// Shape  `columns` x `rows` lines, whole blocks and one more; the crossings of a line from the outermost
///        inwards.
struct GridCrossings {
    ReliefGrid grid;
    int columns = 0, rows = 0;
    std::vector<std::uint32_t> first; ///< start of each line, and the end
    std::vector<Crossing> crossings;
    std::vector<SheetEnd> ends; ///< sorted by cells

    [[nodiscard]] std::span<const SheetEnd> ends_in(int column, int row) const;
    [[nodiscard]] std::span<const Crossing> of(int column, int row) const {
        const std::size_t k = line(column, row);
        return {crossings.data() + first[k], first[k + 1] - first[k]};
    }
    [[nodiscard]] std::size_t line(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    }
};

[[nodiscard]] glm::dvec3 grid_from_box(const ReliefGrid& grid, const glm::dvec3& point, double texel_box);

/// Crossings of the 9 x 9 lines through a cell, an eighth of a texel apart. It keeps its memory from cell to cell.
struct CellCrossings {
    static constexpr int parts = 8; ///< per side of a cell
    static constexpr int lines_along = parts + 1;

    std::vector<LineCrossing> crossings;   ///< line by line, row by row; of a line from the highest down
    std::array<std::uint32_t, 82> first{}; ///< start of each line, and the end

    [[nodiscard]] static constexpr std::size_t line(int i, int j) {
        return static_cast<std::size_t>(j) * lines_along + static_cast<std::size_t>(i);
    }
    [[nodiscard]] std::span<const LineCrossing> of(int i, int j) const {
        const std::size_t k = line(i, j);
        return {crossings.data() + first[k], first[k + 1] - first[k]};
    }
};

/// Finds crossings between the grid's lines, for the cells that the surface does not fill.
class CellLines {
public:
    virtual ~CellLines() = default;
    /// Replaces `found` by the crossings of the cell at (column, row) with heights within `range`: lowest, highest.
    virtual void cross(int column, int row, const glm::dvec2& range, CellCrossings& found) const = 0;

protected:
    CellLines() = default;
    CellLines(const CellLines&) = default;
    CellLines& operator=(const CellLines&) = default;
};

} // namespace frustumscreen::relief
