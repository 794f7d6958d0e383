#include "app/relief/block_items.h"

#include "app/relief/lanes.h"

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

FRUSTUMSCREEN_INLINE Facing facing_of(const ReliefBlock& block, const glm::vec3& eye) {
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
    float reach = 0.0F, early = 0.0F; ///< as BlockItem has them
};

/// Newton's step contracts by about falls / rises - 1 times what is left; so many steps leave some hundredths of a texel.
FRUSTUMSCREEN_INLINE Path path_of(const ReliefBlock& block, const Facing& facing) {
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
    return {search, 1.1F * shift + 0.05F, 1.1F * residual / -facing.rises + 1e-4F};
}

struct Bounds {
    float left, right, top, bottom;
    bool in_front; ///< all of the block; else the others say nothing
    bool outside;  ///< of an edge of the face
};

/// Of the eight corners of the block's slab, in pixels.
FRUSTUMSCREEN_INLINE Bounds bounds_of(const ReliefBlock& block, const GridView& grid, const CastFace& face) {
    const float i0 = block.cells[0];
    const float i1 = block.cells[1];
    const float j0 = block.cells[2];
    const float j1 = block.cells[3];
    const float r0 = block.residual_low;
    const float r1 = block.residual_high();
    const Floats i = {i0, i1, i0, i1, i0, i1, i0, i1};
    const Floats j = {j0, j0, j1, j1, j0, j0, j1, j1};
    const Floats r = {r0, r0, r0, r0, r1, r1, r1, r1};
    const Floats u = block.u0 + i;
    const Floats v = block.v0 + j;
    const Floats w = block.w0 + block.w_u * i + block.w_v * j + r;
    const auto row = [&](std::size_t k) {
        const glm::vec4& of = grid.pixel[k];
        return of.x * u + of.y * v + of.z * w + of.w;
    };
    const Floats xw = row(0);
    const Floats yw = row(1);
    const Floats nearness = row(2);
    if (least_of(nearness) > 0.0F) {
        const Floats x = xw / nearness;
        const Floats y = yw / nearness;
        return {least_of(x), most_of(x), least_of(y), most_of(y), true, false};
    }
    // An edge and the eye span a plane of the box's frame, on whose sides the corners are also where they have no pixel.
    bool outside = false;
    for (const glm::dvec3& edge : face.edges) {
        const Floats inside = static_cast<float>(edge.x) * xw + static_cast<float>(edge.y) * yw +
                              static_cast<float>(edge.z) * nearness;
        outside = outside || most_of(inside) < 0.0F;
    }
    return {0.0F, 0.0F, 0.0F, 0.0F, false, outside};
}

enum class Place { Outside, Across, Inside };

FRUSTUMSCREEN_INLINE Place place_of(const Bounds& bounds, const CastFace& face) {
    if (!bounds.in_front) {
        return bounds.outside ? Place::Outside : Place::Across;
    }
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

/// The tiles that hold some of the pixels [left, right) x [top, bottom).
FRUSTUMSCREEN_INLINE TileRectangle tiles_of(int left, int right, int top, int bottom) {
    if (left >= right || top >= bottom) {
        return {};
    }
    return {static_cast<std::uint16_t>(left / tile_width),
            static_cast<std::uint16_t>((right + tile_width - 1) / tile_width),
            static_cast<std::uint16_t>(top / tile_height),
            static_cast<std::uint16_t>((bottom + tile_height - 1) / tile_height)};
}

/// False: none of the face's pixels.
FRUSTUMSCREEN_INLINE bool set_tiles(BlockItem& item, const Bounds& bounds, const PixelRectangle& lit) {
    const int right = lit.x + lit.width;
    const int bottom = lit.y + lit.height;
    if (!bounds.in_front) {
        item.centres = item.area = tiles_of(lit.x, right, lit.y, bottom);
        return !lit.empty();
    }
    constexpr float slack = 0.01F; // pixels: of 32-bit rounding
    const auto first = [](float at) { return static_cast<int>(std::floor(std::max(at - slack, -1.0F))); };
    const auto end = [](float at) { return static_cast<int>(std::floor(std::min(at + slack, 65e3F))) + 1; };
    item.area = tiles_of(std::max(first(bounds.left), lit.x), std::min(end(bounds.right), right),
                         std::max(first(bounds.top), lit.y), std::min(end(bounds.bottom), bottom));
    if (item.area.first_column == item.area.end_column) {
        return false;
    }
    item.centres =
        tiles_of(std::max(first(bounds.left + 0.5F), lit.x), std::min(end(bounds.right - 0.5F), right),
                 std::max(first(bounds.top + 0.5F), lit.y), std::min(end(bounds.bottom - 0.5F), bottom));
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

FRUSTUMSCREEN_INLINE std::uint8_t bin_of(const ReliefBlock& block, const glm::vec3& eye, const Range& range) {
    constexpr float half = 0.5F * block_cells;
    const glm::vec3 middle(block.u0 + half, block.v0 + half, block.w0 + half * (block.w_u + block.w_v));
    const float bin = (glm::distance(middle, eye) - range.near) * range.bins_per_texel;
    return static_cast<std::uint8_t>(std::clamp(bin, 0.0F, static_cast<float>(bins - 1)));
}

/// Of one block, in the pixels of every face that may show it.
FRUSTUMSCREEN_INLINE void list_block(std::vector<BlockItem>& list, const BlockItems& items,
                                     const CastView& view, const ReliefBlock& block, BlockItem item) {
    for (std::size_t f = 0; f < view.faces.size(); ++f) {
        const Bounds bounds = bounds_of(block, items.grids[f][item.direction], view.faces[f]);
        const Place place = place_of(bounds, view.faces[f]);
        item.face = static_cast<std::uint8_t>(f);
        item.inside = place == Place::Inside;
        if (place != Place::Outside && set_tiles(item, bounds, view.faces[f].lit)) {
            list.push_back(item);
        }
        if (item.inside) {
            break; // faces share no pixels
        }
    }
}

/// Bands of tile rows that the item's area meets: first, one past the last.
std::array<std::size_t, 2> bands_of(const BlockItem& item) {
    return {item.area.first_row / std::size_t{rows_of_band},
            (item.area.end_row + std::size_t{rows_of_band} - 1) / rows_of_band};
}

void sort_into_bands(BlockItems& items) {
    std::vector<std::uint32_t>& first = items.first_of_band;
    first.assign(2, 0);
    for (const BlockItem& item : items.sorted) {
        const auto [begin, end] = bands_of(item);
        first.resize(std::max(first.size(), end + 2));
        for (std::size_t band = begin; band < end; ++band) {
            ++first[band + 2];
        }
    }
    for (std::size_t k = 2; k < first.size(); ++k) {
        first[k] += first[k - 1];
    }
    items.banded.resize(first.back());
    for (std::size_t k = 0; k < items.sorted.size(); ++k) {
        const auto [begin, end] = bands_of(items.sorted[k]);
        for (std::size_t band = begin; band < end; ++band) {
            items.banded[first[band + 1]++] = static_cast<std::uint32_t>(k);
        }
    }
    first.pop_back();
}

constexpr std::size_t blocks_of_part = 1024;

FRUSTUMSCREEN_INLINE void list(BlockItems& items, const BlockRelief& relief, const CastView& view,
                               std::size_t part) {
    std::vector<BlockItem>& list = items.parts[part];
    list.clear();
    if (view.faces.empty()) {
        return;
    }
    const Range range = range_of(view, static_cast<double>(relief.texel_box));
    const std::size_t end = std::min((part + 1) * blocks_of_part, relief.blocks.size());
    std::size_t direction = 0;
    for (std::size_t k = part * blocks_of_part; k < end; ++k) {
        while (k >= relief.first_block[direction + 1]) {
            ++direction;
        }
        const glm::vec3& eye = items.grids[0][direction].eye;
        const ReliefBlock& block = relief.blocks[k];
        const Facing facing = facing_of(block, eye);
        if (facing.falls > 0.0F) {
            continue;
        }
        const Path path = path_of(block, facing);
        BlockItem item;
        item.block = static_cast<std::uint32_t>(k);
        item.direction = static_cast<std::uint8_t>(direction);
        item.search = path.search;
        item.bin = bin_of(block, eye, range);
        item.reach = path.reach;
        item.early = path.early;
        list_block(list, items, view, block, item);
    }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void list_with_avx2(BlockItems& items, const BlockRelief& relief,
                                            const CastView& view, std::size_t part) {
    list(items, relief, view, part);
}
#endif

void list_plainly(BlockItems& items, const BlockRelief& relief, const CastView& view, std::size_t part) {
    list(items, relief, view, part);
}

} // namespace

void begin_list(BlockItems& items, const BlockRelief& relief, const CastView& view) {
    items.grids.resize(view.faces.size());
    for (std::size_t f = 0; f < view.faces.size(); ++f) {
        for (std::size_t d = 0; d < relief.grids.size(); ++d) {
            items.grids[f][d] = grid_view(relief.grids[d], static_cast<double>(relief.texel_box),
                                          view.faces[f], view.eye_box);
        }
    }
    items.parts.resize((relief.blocks.size() + blocks_of_part - 1) / blocks_of_part);
}

void list_part(BlockItems& items, const BlockRelief& relief, const CastView& view, std::size_t part,
               Instructions instructions) {
#if defined(__x86_64__)
    if (instructions == Instructions::Best && __builtin_cpu_supports("avx2")) {
        list_with_avx2(items, relief, view, part);
        return;
    }
#endif
    list_plainly(items, relief, view, part);
}

/// By bins; in a bin as the blocks are.
void end_list(BlockItems& items) {
    std::array<std::uint32_t, bins + 1> first{};
    for (const std::vector<BlockItem>& part : items.parts) {
        for (const BlockItem& item : part) {
            ++first[item.bin + std::size_t{1}];
        }
    }
    for (std::size_t k = 0; k < bins; ++k) {
        first[k + 1] += first[k];
    }
    items.sorted.resize(first[bins]);
    for (const std::vector<BlockItem>& part : items.parts) {
        for (const BlockItem& item : part) {
            items.sorted[first[item.bin]++] = item;
        }
    }
    sort_into_bands(items);
}

void list_blocks(BlockItems& items, const BlockRelief& relief, const CastView& view,
                 Instructions instructions) {
    begin_list(items, relief, view);
    for (std::size_t part = 0; part < items.parts.size(); ++part) {
        list_part(items, relief, view, part, instructions);
    }
    end_list(items);
}

} // namespace frustumscreen
