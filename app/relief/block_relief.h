/// Layered relief as blocks for rasterization: each has 8 x 8 cells of one connected layer, as a plane with
/// 8-bit residuals at the corners.
///
/// Frames   box (pack.h). Grid of a direction: u and v across it, w along it and outward, in texels:
///          coordinate k of X is sign_k (X[axis[k]] - origin_box[k]) / texel_box, with sign 1 for u and v.
/// Surface  inside the cells of `mask`, at local position (i, j) = (u - u0, v - v0), 0..8: w = w0 + w_u i +
///          w_v j + residual, with the residual bilinear between the corners' codes: residual_low +
///          residual_step * code. It is visible only from the outward side.
/// Threads  values; any.
/// Source   layered depth images (Shade 1998) as relief textures (Oliveira 2000; Kim 2008); blocks:
///          docs/relief.md.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace frustumscreen::relief {

inline constexpr int block_cells = 8;
inline constexpr int block_corners = block_cells + 1;

struct ReliefGrid {
    std::array<int, 3> axis{}; ///< of the box, for u, v, w
    double sign = 1.0;         ///< of w
    glm::dvec3 origin_box{0.0};
};

struct ReliefBlock {
    float u0 = 0.0F, v0 = 0.0F;
    float w0 = 0.0F, w_u = 0.0F, w_v = 0.0F;
    float residual_low = 0.0F, residual_step = 0.0F;
    glm::vec2 gradient_u{0.0F}; ///< smallest and largest gradient of the residual, over all cells
    glm::vec2 gradient_v{0.0F};
    std::array<std::uint8_t, 4> cells{}; ///< first column, one past the last, first row, one past the last
    std::uint64_t mask = 0;              ///< bit 8 row + column: the cell exists, whole or in part
    std::uint64_t cut = 0;               ///< those of `mask` in which the surface ends; `covers` tells where
    std::uint32_t first_cover = 0;       ///< of the block's cut cells, in the order of their bits

    [[nodiscard]] float residual_high() const { return residual_low + 255.0F * residual_step; }
};

struct BlockRelief {
    float texel_box = 0.0F;
    std::vector<ReliefGrid> grids;          ///< one for each direction
    std::vector<std::uint32_t> first_block; ///< start of each direction, and the end
    std::vector<ReliefBlock> blocks;
    /// 64 per block: the codes of a cell's corners (0, 0), (1, 0), (0, 1), (1, 1), from the lowest byte up.
    std::vector<std::uint32_t> corner_codes;
    /// One per cut cell: bit 8 row + column of its 8 x 8 parts is set where the surface exists.
    std::vector<std::uint64_t> covers;
    /// 81 per block, row by row: sRGB codes at the corners.
    std::vector<glm::u8vec4> colours;
};

/// Maps grid coordinates (u, v, w), in texels, to the box.
[[nodiscard]] glm::dmat4 box_from_grid(const ReliefGrid& grid, double texel_box);

/// Position in the box of corner 0..3, in the order of `corner_codes`, of the block's cell 8 row + column.
[[nodiscard]] glm::dvec3 corner_in_box(const BlockRelief& relief, const ReliefGrid& grid, std::size_t block,
                                       std::size_t cell, unsigned corner);

/// Bytes of main memory.
[[nodiscard]] inline std::uint64_t bytes_of(const BlockRelief& relief) {
    const auto bytes = [](const auto& values) { return values.size() * sizeof(values[0]); };
    return bytes(relief.blocks) + bytes(relief.corner_codes) + bytes(relief.covers) + bytes(relief.colours);
}

} // namespace frustumscreen::relief
