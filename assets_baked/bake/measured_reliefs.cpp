#include "assets_baked/bake/measured_reliefs.h"

#include "app/relief/cast_blocks.h"
#include "assets_baked/bake/block_relief.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr std::size_t cells_of_block = std::size_t{block_cells} * block_cells;
constexpr std::size_t triangles_of_cell = 2;
/// Corners of a cell's two triangles, as it is cast (cell_row.h): bit 0 the next column, bit 1 the next row.
constexpr std::array<std::uint32_t, 6> corners_of_cell{0, 1, 2, 3, 2, 1};

/// A cell that is there, in the order of the surface's triangles.
struct Cell {
    std::uint32_t block = 0;
    std::uint32_t cell = 0; ///< 8 row + column
};

template <typename Visit> void for_each_cell(const BlockRelief& relief, Visit visit) {
    for (std::size_t k = 0; k < relief.grids.size(); ++k) {
        for (std::uint32_t block = relief.first_block[k]; block < relief.first_block[k + 1]; ++block) {
            for (std::uint32_t cell = 0; cell < cells_of_block; ++cell) {
                if ((relief.blocks[block].mask >> cell & 1U) != 0) {
                    visit(relief.grids[k], Cell{block, cell});
                }
            }
        }
    }
}

glm::vec3 corner_in_box(const BlockRelief& relief, const ReliefGrid& grid, const Cell& at,
                        std::uint32_t corner) {
    const ReliefBlock& block = relief.blocks[at.block];
    const auto i = static_cast<float>(at.cell % block_cells + (corner & 1U));
    const auto j = static_cast<float>(at.cell / block_cells + (corner >> 1U));
    const std::uint32_t codes = relief.corner_codes[at.block * cells_of_block + at.cell];
    const auto code = static_cast<float>(codes >> 8U * corner & 255U);
    const float residual = block.residual_low + block.residual_step * code;
    const glm::dvec3 place(block.u0 + i, block.v0 + j, block.w0 + block.w_u * i + block.w_v * j + residual);
    glm::dvec3 point(0.0);
    for (int k = 0; k < 3; ++k) {
        const int axis = grid.axis.at(static_cast<std::size_t>(k));
        point[axis] = grid.origin_box[axis] +
                      (k == 2 ? grid.sign : 1.0) * place[k] * static_cast<double>(relief.texel_box);
    }
    return {point};
}

/// The place of a surface's hit in its block, as the cast tells it.
std::uint32_t place_of(std::uint32_t cell, const SurfaceHit& hit) {
    constexpr auto unit = static_cast<float>(CastSamples::places_per_cell);
    const std::size_t first = hit.triangle % triangles_of_cell * 3;
    const std::array<float, 3> weights{1.0F - hit.u - hit.v, hit.u, hit.v};
    glm::vec2 at(static_cast<float>(cell % block_cells), static_cast<float>(cell / block_cells));
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = corners_of_cell.at(first + k);
        at += weights.at(k) * glm::vec2(corner & 1U, corner >> 1U);
    }
    const auto along = [](float value) {
        return static_cast<std::uint32_t>(std::clamp(value * unit, 0.0F, block_cells * unit - 1.0F));
    };
    return along(at.x) | along(at.y) << 16U;
}

/// A relief's surface for rays: where the cut cells have nothing, they pass.
class ReliefScene {
public:
    explicit ReliefScene(const BlockRelief& relief)
        : relief_(relief), surface_(surface_of(relief)), mesh_(as_source(surface_)),
          scene_(mesh_, std::vector<glm::dvec3>(surface_.positions.begin(), surface_.positions.end()),
                 Sides::Both) {
        for_each_cell(relief, [&](const ReliefGrid&, const Cell& cell) { cells_.push_back(cell); });
    }

    [[nodiscard]] const SourceScene& scene() const { return scene_; }
    [[nodiscard]] SurfaceHit trace(const glm::vec3& eye, const glm::vec3& direction) const {
        constexpr float beyond_box = 1e-5F;
        SurfaceHit hit = scene_.trace(eye, direction);
        while (hit.hit && !is_drawn(hit)) {
            hit = scene_.trace(eye, direction, hit.distance + beyond_box);
        }
        return hit;
    }
    /// As measure_colour, of the blocks' corners instead of a texture.
    [[nodiscard]] float colour_rmse(const SourceSamples& samples) const;

private:
    [[nodiscard]] bool is_drawn(const SurfaceHit& hit) const {
        const Cell& cell = cells_[hit.triangle / triangles_of_cell];
        const ReliefBlock& block = relief_.blocks[cell.block];
        const std::uint64_t bit = std::uint64_t{1} << cell.cell;
        if ((block.cut & bit) == 0) {
            return true;
        }
        const auto before = static_cast<std::uint32_t>(std::popcount(block.cut & (bit - 1)));
        const std::uint64_t cover = relief_.covers[block.first_cover + before];
        constexpr std::uint32_t part = CastSamples::places_per_cell / 8;
        const std::uint32_t place = place_of(cell.cell, hit);
        const std::uint32_t column = (place & 0xFFFFU) % CastSamples::places_per_cell / part;
        const std::uint32_t row = (place >> 16U) % CastSamples::places_per_cell / part;
        return (cover >> (8 * row + column) & 1U) != 0;
    }

    const BlockRelief& relief_;
    TriangleMesh surface_;
    SourceMesh mesh_;
    SourceScene scene_;
    std::vector<Cell> cells_;
};

float ReliefScene::colour_rmse(const SourceSamples& samples) const {
    constexpr float reach = 0.2F; // of measure_shape
    double squares = 0.0;
    for (const SourceSamples::Point& point : samples.points) {
        const SurfaceHit hit = scene_.nearest(point.position, reach);
        if (!hit.hit) {
            continue;
        }
        const Cell& cell = cells_[hit.triangle / triangles_of_cell];
        const glm::u8vec4 shown = colour_at(relief_, cell.block, place_of(cell.cell, hit));
        for (int k = 0; k < 3; ++k) {
            const double off =
                static_cast<double>(shown[k]) - srgb8_from_linear(static_cast<double>(point.colour[k]));
            squares += off * off / 3.0;
        }
    }
    return static_cast<float>(
        std::sqrt(squares / static_cast<double>(std::max<std::size_t>(samples.points.size(), 1))));
}

/// The texture, whose texels are a `size`th of the box, with texels about as large as the relief's: so none of it is skipped.
Image8 mip_for(const Image8& texture, int size, int texels) {
    Image8 mip = texture;
    for (int each = size; each >= 2 * texels; each /= 2) {
        mip = half_size(mip);
    }
    return mip;
}

} // namespace

std::vector<int> relief_texels(int size) {
    constexpr int coarsest = 96;
    std::vector<int> texels;
    for (int each = std::min(coarsest, size); each <= size; each *= 2) {
        texels.push_back(each);
    }
    return texels;
}

TriangleMesh surface_of(const BlockRelief& relief) {
    TriangleMesh surface;
    for_each_cell(relief, [&](const ReliefGrid& grid, const Cell& cell) {
        const auto first = static_cast<std::uint32_t>(surface.positions.size());
        for (std::uint32_t corner = 0; corner < 4; ++corner) {
            surface.positions.push_back(corner_in_box(relief, grid, cell, corner));
        }
        for (const std::uint32_t corner : corners_of_cell) {
            surface.indices.push_back(first + corner);
        }
    });
    return surface;
}

std::vector<MeasuredRelief> bake_reliefs(const ReliefSource& source, int size) {
    std::vector<MeasuredRelief> reliefs;
    for (const int texels : relief_texels(size)) {
        const Image8 texture = mip_for(source.texture, size, texels);
        const SourceMesh mesh = textured_source(source.finest, texture, source.box_size);
        const SourceScene scene(mesh, mesh.positions, Sides::Front);
        MeasuredRelief made{bake_blocks({scene, source.box_size, source.directions, texels}), {}};
        if (made.relief.blocks.empty()) {
            continue;
        }
        const ReliefScene drawn(made.relief);
        made.error = seen_distances(
            drawn.scene(),
            [&](const glm::vec3& eye, const glm::vec3& direction) { return drawn.trace(eye, direction); },
            source.truth, source.box_size, source.zone);
        made.error.colour_rmse = source.compare_colour ? drawn.colour_rmse(source.samples) : 0.0F;
        reliefs.push_back(std::move(made));
    }
    return reliefs;
}

} // namespace frustumscreen
