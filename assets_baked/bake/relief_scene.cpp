#include "assets_baked/bake/relief_scene.h"

#include "app/relief/rasterize_blocks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace frustumscreen::bake {

namespace {

constexpr std::size_t cells_of_block = std::size_t{relief::block_cells} * relief::block_cells;
constexpr std::size_t triangles_of_cell = 2;
/// Corners of a cell's two triangles, as it is rasterized (cell_row.h): bit 0 the next column, bit 1 the next
/// row.
constexpr std::array<std::uint32_t, 6> corners_of_cell{0, 1, 2, 3, 2, 1};

using Cell = ReliefScene::Cell;

template <typename Visit> void for_each_cell(const relief::BlockRelief& relief, Visit visit) {
    for (std::size_t k = 0; k < relief.grids.size(); ++k) {
        glm::vec3 outward(0.0F);
        outward[relief.grids[k].axis[2]] = static_cast<float>(relief.grids[k].sign);
        for (std::uint32_t block = relief.first_block[k]; block < relief.first_block[k + 1]; ++block) {
            for (std::uint32_t cell = 0; cell < cells_of_block; ++cell) {
                if ((relief.blocks[block].mask >> cell & 1U) != 0) {
                    visit(relief.grids[k], Cell{block, cell, outward});
                }
            }
        }
    }
}

/// Position of a surface hit in its block, encoded as in RasterSamples.
std::uint32_t place_of(std::uint32_t cell, const SurfaceHit& hit) {
    constexpr auto unit = static_cast<float>(relief::RasterSamples::places_per_cell);
    const std::size_t first = hit.triangle % triangles_of_cell * 3;
    const std::array<float, 3> weights{1.0F - hit.u - hit.v, hit.u, hit.v};
    glm::vec2 at(glm::uvec2(cell % relief::block_cells, cell / relief::block_cells));
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = corners_of_cell.at(first + k);
        at += weights.at(k) * glm::vec2(corner & 1U, corner >> 1U);
    }
    const auto along = [](float value) {
        return static_cast<std::uint32_t>(std::clamp(value * unit, 0.0F, relief::block_cells * unit - 1.0F));
    };
    return along(at.x) | along(at.y) << 16U;
}

} // namespace

TriangleMesh surface_of(const relief::BlockRelief& relief) {
    TriangleMesh surface;
    for_each_cell(relief, [&](const relief::ReliefGrid& grid, const Cell& cell) {
        const auto first = static_cast<std::uint32_t>(surface.positions.size());
        for (std::uint32_t corner = 0; corner < 4; ++corner) {
            surface.positions.emplace_back(
                relief::corner_in_box(relief, grid, cell.block, cell.cell, corner));
        }
        for (const std::uint32_t corner : corners_of_cell) {
            surface.indices.push_back(first + corner);
        }
    });
    return surface;
}

ReliefScene::ReliefScene(const relief::BlockRelief& relief)
    : relief_(relief), surface_(surface_of(relief)), mesh_(as_source(surface_)),
      scene_(mesh_, std::vector<glm::dvec3>(surface_.positions.begin(), surface_.positions.end()),
             Sides::Both) {
    for_each_cell(relief, [&](const relief::ReliefGrid&, const Cell& cell) { cells_.push_back(cell); });
}

SurfaceHit ReliefScene::trace(const glm::vec3& eye, const glm::vec3& direction) const {
    return scene_.trace(eye, direction, [&](const SurfaceHit& hit) { return is_drawn(hit, direction); });
}

bool ReliefScene::is_drawn(const SurfaceHit& hit, const glm::vec3& direction) const {
    const Cell& cell = cells_[hit.triangle / triangles_of_cell];
    const auto corner = [&](std::size_t k) {
        return surface_.positions[surface_.indices[std::size_t{3} * hit.triangle + k]];
    };
    const glm::vec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    if (glm::dot(normal, direction) * glm::dot(normal, cell.outward) >= 0.0F) {
        return false;
    }
    const relief::ReliefBlock& block = relief_.blocks[cell.block];
    const std::uint64_t bit = std::uint64_t{1} << cell.cell;
    if ((block.cut & bit) == 0) {
        return true;
    }
    const auto before = static_cast<std::uint32_t>(std::popcount(block.cut & (bit - 1)));
    const std::uint64_t cover = relief_.covers[block.first_cover + before];
    constexpr std::uint32_t part = relief::RasterSamples::places_per_cell / 8;
    const std::uint32_t place = place_of(cell.cell, hit);
    const std::uint32_t column = (place & 0xFFFFU) % relief::RasterSamples::places_per_cell / part;
    const std::uint32_t row = (place >> 16U) % relief::RasterSamples::places_per_cell / part;
    return (cover >> (8 * row + column) & 1U) != 0;
}

float ReliefScene::colour_rmse(const SourceSamples& samples) const {
    constexpr float reach = 0.2F; // as in measure_shape
    double squares = 0.0;
    for (const SourceSamples::Point& point : samples.points) {
        const SurfaceHit hit = scene_.nearest(point.position, reach);
        if (!hit.hit) {
            continue;
        }
        const Cell& cell = cells_[hit.triangle / triangles_of_cell];
        const glm::u8vec4 shown = relief::colour_at(relief_, cell.block, place_of(cell.cell, hit));
        for (int k = 0; k < 3; ++k) {
            const double off = static_cast<double>(shown[k]) -
                               image::srgb8_from_linear(static_cast<double>(point.colour[k]));
            squares += off * off / 3.0;
        }
    }
    return static_cast<float>(
        std::sqrt(squares / static_cast<double>(std::max<std::size_t>(samples.points.size(), 1))));
}

} // namespace frustumscreen::bake
