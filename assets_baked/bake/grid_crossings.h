/// The points where the lines of a direction's grid cross a surface from its front.
///
/// Frames   box; the direction's grid (app/relief/block_relief.h).
/// Threads  uses every core; the result does not depend on their number.
#pragma once

#include "assets_baked/bake/block_relief.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace frustumscreen::bake {

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
    bool own = false; ///< no direction sees it clearly better
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
    relief::ReliefGrid grid;
    int columns = 0, rows = 0;
    std::vector<std::uint32_t> first; ///< start of each line, and the end
    std::vector<Crossing> crossings;
    std::vector<SheetEnd> ends; ///< sorted by cells

    [[nodiscard]] std::span<const SheetEnd> ends_in(int column, int row) const;
    [[nodiscard]] std::span<const Crossing> of(int column, int row) const {
        const std::size_t k = line(column, row);
        return {&crossings[first[k]], first[k + 1] - first[k]};
    }
    [[nodiscard]] std::size_t line(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    }
};

/// Finds the crossings of any line (u, v), on the grid or between its lines, with heights within `range`
/// (lowest, highest), highest first; stored in `found`, which is cleared first.
void cross_line(const BlockInput& input, const relief::ReliefGrid& grid, const glm::dvec2& at,
                const glm::dvec2& range, std::vector<LineCrossing>& found);

/// The crossing that the direction gets from a hit anywhere on the surface: height, slopes, owner, colour;
/// nullopt if the surface is too flat to the direction's lines or faces away. Of the hit, triangle, position
/// in it, point and normal are used.
[[nodiscard]] std::optional<Crossing> crossing_from(const BlockInput& input, const relief::ReliefGrid& grid,
                                                    const SurfaceHit& hit);

[[nodiscard]] glm::dvec3 grid_from_box(const relief::ReliefGrid& grid, const glm::dvec3& point,
                                       double texel_box);

[[nodiscard]] GridCrossings cross_grid(const BlockInput& input, pack::ReliefDirection direction);

} // namespace frustumscreen::bake
