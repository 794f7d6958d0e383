/// Where the lines of a direction's grid cross a surface from its front.
///
/// Frames   box; the direction's grid (app/relief/block_relief.h).
/// Threads  uses every core; the same result with any number of them.
#pragma once

#include "assets_baked/bake/block_relief.h"

#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen {

struct Crossing {
    float w = 0.0F;                       ///< texels
    float slope_u = 0.0F, slope_v = 0.0F; ///< what w changes by from texel to texel
    bool own = false;                     ///< no direction sees it clearly better
    glm::u8vec4 colour{0};
};

/// Shape  `columns` x `rows` lines, whole blocks and one more; the crossings of a line from the outermost inwards.
struct GridCrossings {
    ReliefGrid grid;
    int columns = 0, rows = 0;
    std::vector<std::uint32_t> first; ///< of each line; one more at the end
    std::vector<Crossing> crossings;

    [[nodiscard]] std::span<const Crossing> of(int column, int row) const {
        const std::size_t k = line(column, row);
        return {&crossings[first[k]], first[k + 1] - first[k]};
    }
    [[nodiscard]] std::size_t line(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    }
    [[nodiscard]] glm::dvec3 box_from_grid(double u, double v, double w, double texel_box) const {
        glm::dvec3 at(grid.origin_box);
        at[grid.axis[0]] += u * texel_box;
        at[grid.axis[1]] += v * texel_box;
        at[grid.axis[2]] += grid.sign * w * texel_box;
        return at;
    }
};

[[nodiscard]] GridCrossings cross_grid(const BlockInput& input, ReliefDirection direction);

} // namespace frustumscreen
