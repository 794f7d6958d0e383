#include "app/relief/block_relief.h"

namespace frustumscreen::relief {

glm::dmat4 box_from_grid(const ReliefGrid& grid, double texel_box) {
    const glm::dvec3 signs(1.0, 1.0, grid.sign);
    glm::dmat4 box(0.0);
    for (int k = 0; k < 3; ++k) {
        box[k][grid.axis.at(static_cast<std::size_t>(k))] = signs[k] * texel_box;
    }
    box[3] = glm::dvec4(grid.origin_box, 1.0);
    return box;
}

glm::dvec3 corner_in_box(const BlockRelief& relief, const ReliefGrid& grid, std::size_t block,
                         std::size_t cell, unsigned corner) {
    const ReliefBlock& of = relief.blocks[block];
    const std::uint32_t codes = relief.corner_codes[block * block_cells * block_cells + cell];
    const std::size_t row = cell / block_cells;
    const auto i = static_cast<double>(cell % block_cells + (corner & 1U));
    const auto j = static_cast<double>(row + (corner >> 1U));
    const double w = of.w0 + of.w_u * i + of.w_v * j + of.residual_low +
                     of.residual_step * static_cast<double>(codes >> 8U * corner & 255U);
    return glm::dvec3(box_from_grid(grid, static_cast<double>(relief.texel_box)) *
                      glm::dvec4(of.u0 + i, of.v0 + j, w, 1.0));
}

} // namespace frustumscreen::relief
