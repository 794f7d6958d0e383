#include "app/bench/techniques/relief_surface.h"

#include "app/image/image.h"

#include <bit>

namespace frustumscreen::bench {

namespace {

constexpr int cells_of_block = relief::block_cells * relief::block_cells;
constexpr int parts = 8; ///< along a side of a cut cell

struct Corners {
    std::array<glm::dvec3, 4> places; ///< (0, 0), (1, 0), (0, 1), (1, 1)
    std::array<glm::vec4, 4> colours; ///< linear
};

Corners corners_of(const relief::BlockRelief& relief, const relief::ReliefGrid& grid, std::size_t block,
                   int cell) {
    const auto number = static_cast<std::size_t>(cell);
    Corners corners{};
    for (unsigned k = 0; k < 4; ++k) {
        corners.places.at(k) = relief::corner_in_box(relief, grid, block, number, k);
        const std::size_t colour =
            (block * relief::block_corners + number / relief::block_cells + (k >> 1U)) *
                relief::block_corners +
            number % relief::block_cells + (k & 1U);
        const std::array<float, 256>& linear = image::linear_from_srgb8();
        const glm::u8vec4 code = relief.colours[colour];
        corners.colours.at(k) = {linear[code.r], linear[code.g], linear[code.b], 1.0F};
    }
    return corners;
}

class Surface {
public:
    Surface() { mesh_.materials.emplace_back(); }
    /// Adds the square of side `side` at (u, v), in shares of the cell. Its diagonal lies on the cell's own,
    /// or next to it.
    void add(const Corners& cell, const glm::dvec3& outward, double u, double v, double side) {
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
        for (unsigned k = 0; k < 4; ++k) {
            const double at_u = u + (k & 1U) * side;
            const double at_v = v + (k >> 1U) * side;
            mesh_.positions.push_back(on_triangles(cell.places, at_u, at_v));
            mesh_.colours.push_back(on_triangles(cell.colours, at_u, at_v));
        }
        add_triangle({first, first + 1, first + 2}, outward);
        add_triangle({first + 3, first + 2, first + 1}, outward);
    }
    [[nodiscard]] bake::SourceMesh take() { return std::move(mesh_); }

private:
    /// Interpolates between the corners (0, 0), (1, 0), (0, 1) or the other three, on the cell's two
    /// triangles.
    template <typename T> static T on_triangles(const std::array<T, 4>& corner, double u, double v) {
        using Scalar = typename T::value_type;
        const auto x = static_cast<Scalar>(u);
        const auto y = static_cast<Scalar>(v);
        return u + v <= 1.0
                   ? corner[0] + x * (corner[1] - corner[0]) + y * (corner[2] - corner[0])
                   : corner[3] + (1 - x) * (corner[2] - corner[3]) + (1 - y) * (corner[1] - corner[3]);
    }
    void add_triangle(std::array<std::uint32_t, 3> of, const glm::dvec3& outward) {
        const auto& at = mesh_.positions;
        if (glm::dot(glm::cross(at[of[1]] - at[of[0]], at[of[2]] - at[of[0]]), outward) < 0.0) {
            std::swap(of[1], of[2]);
        }
        mesh_.triangles.push_back(of);
        mesh_.triangle_materials.push_back(0);
    }
    bake::SourceMesh mesh_;
};

} // namespace

bake::SourceMesh cut_surface_of(const relief::BlockRelief& relief) {
    Surface surface;
    for (std::size_t k = 0; k < relief.grids.size(); ++k) {
        const relief::ReliefGrid& grid = relief.grids[k];
        glm::dvec3 outward(0.0);
        outward[grid.axis[2]] = grid.sign;
        for (std::size_t block = relief.first_block[k]; block < relief.first_block[k + 1]; ++block) {
            const relief::ReliefBlock& of = relief.blocks[block];
            std::size_t cover = of.first_cover;
            for (int cell = 0; cell < cells_of_block; ++cell) {
                const std::uint64_t bit = std::uint64_t{1} << static_cast<unsigned>(cell);
                if ((of.mask & bit) == 0) {
                    continue;
                }
                const Corners corners = corners_of(relief, grid, block, cell);
                if ((of.cut & bit) == 0) {
                    surface.add(corners, outward, 0.0, 0.0, 1.0);
                    continue;
                }
                std::uint64_t left = relief.covers[cover++];
                for (; left != 0; left &= left - 1) {
                    const int part = std::countr_zero(left);
                    const glm::dvec2 at = glm::dvec2(glm::ivec2(part % parts, part / parts)) / double{parts};
                    surface.add(corners, outward, at.x, at.y, 1.0 / parts);
                }
            }
        }
    }
    return surface.take();
}

} // namespace frustumscreen::bench
