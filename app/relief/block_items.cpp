#include "app/relief/block_items.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr std::size_t bins = 64;

GridView grid_view(const ReliefGrid& grid, double texel_box, const CastFace& face,
                   const glm::dvec3& eye_box) {
    GridView view;
    const glm::dvec3 signs(1.0, 1.0, grid.sign);
    for (int k = 0; k < 3; ++k) {
        const double texels = signs[k] / texel_box;
        const int axis = grid.axis[static_cast<std::size_t>(k)];
        for (int column = 0; column < 3; ++column) {
            view.ray[static_cast<std::size_t>(k)][column] =
                static_cast<float>(texels * face.direction[column][axis]);
        }
        view.eye[k] = static_cast<float>(texels * (eye_box[axis] - grid.origin_box[axis]));
    }
    for (int row = 0; row < 3; ++row) {
        double constant = face.pixel_from_box[3][row];
        for (int k = 0; k < 3; ++k) {
            const int axis = grid.axis[static_cast<std::size_t>(k)];
            view.pixel[static_cast<std::size_t>(row)][k] =
                static_cast<float>(face.pixel_from_box[axis][row] * signs[k] * texel_box);
            constant += face.pixel_from_box[axis][row] * grid.origin_box[axis];
        }
        view.pixel[static_cast<std::size_t>(row)].w = static_cast<float>(constant);
    }
    return view;
}

/// How a block lies to the eye. Along an eye ray of this direction the height above the surface changes by the ray's length times a
/// number within [falls, rises]; negative: the ray goes in.
struct Facing {
    float falls = 0.0F, rises = 0.0F;
    float aside = 0.0F; ///< of the ray, across the grid
};

Facing facing_of(const ReliefBlock& block, const glm::vec3& eye) {
    constexpr float half = 0.5F * block_cells;
    const float du = block.u0 + half - eye.x;
    const float dv = block.v0 + half - eye.y;
    const float dw = block.w0 + half * (block.w_u + block.w_v) - eye.z;
    const float plane = dw - block.w_u * du - block.w_v * dv;
    const float u_low = block.gradient_u.x * du;
    const float u_high = block.gradient_u.y * du;
    const float v_low = block.gradient_v.x * dv;
    const float v_high = block.gradient_v.y * dv;
    const float aside = std::sqrt(du * du + dv * dv);
    // The ray turns by about 8 cells / distance over the block; 1 % of what lies across covers that.
    const float margin = 0.01F * aside;
    return {plane - std::max(u_low, u_high) - std::max(v_low, v_high) - margin,
            plane - std::min(u_low, u_high) - std::min(v_low, v_high) + margin, aside};
}

struct Path {
    Search search = Search::March;
    float reach = 0.0F;
};

/// Newton's step contracts by about falls / rises - 1 times what is left; so many steps leave some hundredths of a texel.
Path path_of(const ReliefBlock& block, const Facing& facing) {
    if (!(facing.rises < 0.0F)) {
        return {};
    }
    const float residual = std::max(std::abs(block.residual_low), std::abs(block.residual_high()));
    const float contraction = facing.falls / facing.rises - 1.0F;
    const float shift = residual * facing.aside / -facing.rises;
    constexpr float marched_above = 6.0F;
    constexpr float one_step_below = 0.03F; // texels
    constexpr float two_steps_below = 0.6F;
    if (contraction > marched_above) {
        return {};
    }
    const Search search = contraction * shift < one_step_below ? Search::Newton1
                          : contraction < two_steps_below      ? Search::Newton2
                                                               : Search::Newton3;
    return {search, 1.1F * shift + 0.05F};
}

struct Bounds {
    float left, right, top, bottom;
};

/// Of the eight corners of the block's slab, in pixels; all of them lie in front of the eye.
Bounds bounds_of(const ReliefBlock& block, const GridView& grid) {
    const float i0 = block.cells[0];
    const float i1 = block.cells[1];
    const float j0 = block.cells[2];
    const float j1 = block.cells[3];
    Bounds bounds{INFINITY, -INFINITY, INFINITY, -INFINITY};
    for (unsigned k = 0; k < 8; ++k) {
        const float i = (k & 1U) != 0 ? i1 : i0;
        const float j = (k & 2U) != 0 ? j1 : j0;
        const float r = (k & 4U) != 0 ? block.residual_high() : block.residual_low;
        const glm::vec4 at(block.u0 + i, block.v0 + j, block.w0 + block.w_u * i + block.w_v * j + r, 1.0F);
        const float nearness = 1.0F / glm::dot(grid.pixel[2], at);
        const float x = glm::dot(grid.pixel[0], at) * nearness;
        const float y = glm::dot(grid.pixel[1], at) * nearness;
        bounds = {std::min(bounds.left, x), std::max(bounds.right, x), std::min(bounds.top, y),
                  std::max(bounds.bottom, y)};
    }
    return bounds;
}

enum class Place { Outside, Across, Inside };

Place place_of(const Bounds& bounds, const CastFace& face) {
    Place place = Place::Inside;
    for (const glm::dvec3& edge : face.edges) {
        const auto x = static_cast<float>(edge.x);
        const auto y = static_cast<float>(edge.y);
        const auto rest = static_cast<float>(edge.z);
        const float most =
            rest + std::max(x * bounds.left, x * bounds.right) + std::max(y * bounds.top, y * bounds.bottom);
        const float least =
            rest + std::min(x * bounds.left, x * bounds.right) + std::min(y * bounds.top, y * bounds.bottom);
        if (most < -0.5F) {
            return Place::Outside;
        }
        place = least > 1.0F ? place : Place::Across;
    }
    return place;
}

/// The tiles that hold a pixel's centre within the bounds; false: none does.
bool set_tiles(BlockItem& item, const Bounds& bounds, const PixelRectangle& lit) {
    constexpr float slack = 0.01F; // pixels: of 32-bit rounding
    const int left =
        std::max(static_cast<int>(std::floor(std::max(bounds.left - slack, -1.0F) + 0.5F)), lit.x);
    const int top = std::max(static_cast<int>(std::floor(std::max(bounds.top - slack, -1.0F) + 0.5F)), lit.y);
    const int right = std::min(static_cast<int>(std::floor(std::min(bounds.right + slack, 65e3F) + 0.5F)),
                               lit.x + lit.width);
    const int bottom = std::min(static_cast<int>(std::floor(std::min(bounds.bottom + slack, 65e3F) + 0.5F)),
                                lit.y + lit.height);
    if (left >= right || top >= bottom) {
        return false;
    }
    item.first_column = static_cast<std::uint16_t>(left / tile_width);
    item.end_column = static_cast<std::uint16_t>((right + tile_width - 1) / tile_width);
    item.first_row = static_cast<std::uint16_t>(top / tile_height);
    item.end_row = static_cast<std::uint16_t>((bottom + tile_height - 1) / tile_height);
    return true;
}

/// Nearest to farthest of the box, in texels.
struct Range {
    float near = 0.0F, bins_per_texel = 0.0F;
};

Range range_of(const CastView& view, double texel_box) {
    const double middle = glm::distance(view.eye_box, glm::dvec3(0.0, 0.0, 0.5));
    constexpr double radius_box = 1.0; // the longest edge is 1, so no corner is farther from the middle
    const double near = std::max(middle - radius_box, 0.0);
    return {static_cast<float>(near / texel_box),
            static_cast<float>(bins * texel_box / (middle + radius_box - near))};
}

std::uint8_t bin_of(const ReliefBlock& block, const glm::vec3& eye, const Range& range) {
    constexpr float half = 0.5F * block_cells;
    const glm::vec3 middle(block.u0 + half, block.v0 + half, block.w0 + half * (block.w_u + block.w_v));
    const float bin = (glm::distance(middle, eye) - range.near) * range.bins_per_texel;
    return static_cast<std::uint8_t>(std::clamp(bin, 0.0F, static_cast<float>(bins - 1)));
}

void sort_by_bin(BlockItems& items) {
    std::array<std::uint32_t, bins + 1> first{};
    for (const BlockItem& item : items.unsorted) {
        ++first[item.bin + std::size_t{1}];
    }
    for (std::size_t k = 0; k < bins; ++k) {
        first[k + 1] += first[k];
    }
    items.sorted.resize(items.unsorted.size());
    for (const BlockItem& item : items.unsorted) {
        items.sorted[first[item.bin]++] = item;
    }
}

} // namespace

void list_blocks(BlockItems& items, const BlockRelief& relief, const CastView& view) {
    items.unsorted.clear();
    items.grids.resize(view.faces.size());
    for (std::size_t f = 0; f < view.faces.size(); ++f) {
        for (std::size_t d = 0; d < relief.grids.size(); ++d) {
            items.grids[f][d] = grid_view(relief.grids[d], static_cast<double>(relief.texel_box),
                                          view.faces[f], view.eye_box);
        }
    }
    if (view.faces.empty()) {
        items.sorted.clear();
        return;
    }
    const Range range = range_of(view, static_cast<double>(relief.texel_box));
    for (std::size_t d = 0; d < relief.grids.size(); ++d) {
        const glm::vec3 eye = items.grids[0][d].eye;
        for (std::uint32_t k = relief.first_block[d]; k < relief.first_block[d + 1]; ++k) {
            const ReliefBlock& block = relief.blocks[k];
            const Facing facing = facing_of(block, eye);
            if (facing.falls > 0.0F) {
                continue;
            }
            const Path path = path_of(block, facing);
            BlockItem item{k,
                           0,
                           0,
                           0,
                           0,
                           0,
                           static_cast<std::uint8_t>(d),
                           path.search,
                           false,
                           bin_of(block, eye, range),
                           path.reach};
            for (std::size_t f = 0; f < view.faces.size(); ++f) {
                const Bounds bounds = bounds_of(block, items.grids[f][d]);
                const Place place = place_of(bounds, view.faces[f]);
                item.face = static_cast<std::uint8_t>(f);
                item.inside = place == Place::Inside;
                if (place != Place::Outside && set_tiles(item, bounds, view.faces[f].lit)) {
                    items.unsorted.push_back(item);
                }
                if (item.inside) {
                    break; // faces share no pixels
                }
            }
        }
    }
    sort_by_bin(items);
}

} // namespace frustumscreen
