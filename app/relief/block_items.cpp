#include "app/relief/block_items.h"

#include "app/relief/lens_lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::relief {

namespace {

constexpr std::size_t bins = 64;

GridView grid_view(const ReliefGrid& grid, double texel_box, const RasterFace& face,
                   const glm::dvec3& eye_box) {
    GridView view;
    const glm::dvec3 signs(1.0, 1.0, grid.sign);
    for (int k = 0; k < 3; ++k) {
        const int axis = grid.axis[static_cast<std::size_t>(k)];
        view.eye[k] = static_cast<float>(signs[k] / texel_box * (eye_box[axis] - grid.origin_box[axis]));
    }
    // The ray t D (x, y, 1) from the eye lights w (x, y, 1): the product of the two matrices only scales, by
    // w / t.
    const double w_per_t = (glm::dmat3(face.pixel_from_box) * face.direction)[2][2];
    for (int row = 0; row < 3; ++row) {
        double constant = face.pixel_from_box[3][row];
        for (int k = 0; k < 3; ++k) {
            const int axis = grid.axis[static_cast<std::size_t>(k)];
            view.pixel[static_cast<std::size_t>(row)][k] =
                static_cast<float>(face.pixel_from_box[axis][row] * signs[k] * texel_box / w_per_t);
            constant += face.pixel_from_box[axis][row] * grid.origin_box[axis];
        }
        view.pixel[static_cast<std::size_t>(row)].w = static_cast<float>(constant / w_per_t);
    }
    return view;
}

/// True if any of the block's cells may face the eye: along an eye ray as long as the distance from the eye
/// to the block's middle, the height above the surface decreases somewhere. Away: it increases.
FRUSTUMSCREEN_INLINE bool may_face(const ReliefBlock& block, const glm::vec3& eye, Facing facing) {
    constexpr float half = 0.5F * block_cells;
    const float du = block.u0 + half - eye.x;
    const float dv = block.v0 + half - eye.y;
    const float dw = block.w0 + half * (block.w_u + block.w_v) - eye.z;
    const float plane = dw - block.w_u * du - block.w_v * dv;
    // The ray turns by about 8 cells / distance across the block; 1 % of the lateral distance covers that.
    const float margin = 0.01F * std::sqrt(du * du + dv * dv);
    if (facing == Facing::Away) {
        return plane - std::min(block.gradient_u.x * du, block.gradient_u.y * du) -
                   std::min(block.gradient_v.x * dv, block.gradient_v.y * dv) + margin >=
               0.0F;
    }
    return plane - std::max(block.gradient_u.x * du, block.gradient_u.y * du) -
               std::max(block.gradient_v.x * dv, block.gradient_v.y * dv) - margin <=
           0.0F;
}

struct Sides {
    float left, right, top, bottom;
};
constexpr Sides everywhere{.left = -1.0F, .right = 65e3F, .top = -1.0F, .bottom = 65e3F};

FRUSTUMSCREEN_INLINE Sides sides_of(const PixelLanes& at) {
    return {.left = min_of(at.x), .right = max_of(at.x), .top = min_of(at.y), .bottom = max_of(at.y)};
}

/// Bounds of the corners' pixels after distortion. The second derivative of a distorted pixel is at most 6
/// |k1| r + 20 |k2| r^3, in units of the focal length. So a point between corners that are D apart is
/// displaced by at most a quarter of that times D^2 from its place between their distorted positions.
FRUSTUMSCREEN_INLINE Sides lit_sides(const PixelLens& lens, const PixelLanes& corners, const Sides& ideal) {
    const float r2 = max_of(squared_radius(lens, corners));
    if (!(r2 <= lens.max_r2)) {
        return everywhere;
    }
    const float along = std::max(lens.focal.x, lens.focal.y) * std::max(lens.per_focal.x, lens.per_focal.y);
    const float second = std::sqrt(r2) * (6.0F * std::abs(lens.k1) + 20.0F * std::abs(lens.k2) * r2) * along *
                         std::max(lens.per_focal.x, lens.per_focal.y);
    const float width = ideal.right - ideal.left;
    const float height = ideal.bottom - ideal.top;
    const float beside = 0.25F * second * (width * width + height * height);
    const Sides lit = sides_of(bent(lens, corners));
    return {.left = lit.left - beside,
            .right = lit.right + beside,
            .top = lit.top - beside,
            .bottom = lit.bottom + beside};
}

struct Bounds {
    Sides ideal;   ///< pixels
    Sides lit;     ///< of the projector's picture
    float nearest; ///< 1 / t
    bool in_front; ///< the whole block; otherwise the other bounds are invalid
    bool outside;  ///< beyond an edge of the face
};

/// Bounds of the eight corners of the block's slab, in pixels.
FRUSTUMSCREEN_INLINE Bounds bounds_of(const ReliefBlock& block, const GridView& grid, const RasterFace& face,
                                      const PixelLens& lens) {
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
    const auto row = [&](std::size_t k) FRUSTUMSCREEN_INLINED {
        const glm::vec4& of = grid.pixel[k];
        return of.x * u + of.y * v + of.z * w + of.w;
    };
    const Floats xt = row(0);
    const Floats yt = row(1);
    const Floats t = row(2);
    const float shortest = min_of(t);
    if (shortest > 0.0F) {
        const PixelLanes corners{xt / t, yt / t};
        const Sides ideal = sides_of(corners);
        constexpr float rounding = 1.0001F;
        return {.ideal = ideal,
                .lit = lens.bends ? lit_sides(lens, corners, ideal) : ideal,
                .nearest = rounding / shortest,
                .in_front = true,
                .outside = false};
    }
    // An edge and the eye span a plane in the box frame. Its test also works for corners without a pixel.
    bool outside = false;
    for (const glm::dvec3& edge : face.edges) {
        const Floats inside = static_cast<float>(edge.x) * xt + static_cast<float>(edge.y) * yt +
                              static_cast<float>(edge.z) * t;
        outside = outside || max_of(inside) < 0.0F;
    }
    return {.ideal = everywhere,
            .lit = everywhere,
            .nearest = std::numeric_limits<float>::infinity(),
            .in_front = false,
            .outside = outside};
}

enum class Place { Outside, Across, Inside };

FRUSTUMSCREEN_INLINE Place place_of(const Bounds& bounds, const RasterFace& face) {
    if (!bounds.in_front) {
        return bounds.outside ? Place::Outside : Place::Across;
    }
    const Sides& at = bounds.ideal;
    Place place = Place::Inside;
    for (const glm::dvec3& edge : face.edges) {
        const auto x = static_cast<float>(edge.x);
        const auto y = static_cast<float>(edge.y);
        const auto rest = static_cast<float>(edge.z);
        const float most = rest + std::max(x * at.left, x * at.right) + std::max(y * at.top, y * at.bottom);
        const float least = rest + std::min(x * at.left, x * at.right) + std::min(y * at.top, y * at.bottom);
        if (most < -0.5F) {
            return Place::Outside;
        }
        place = least > 1.0F ? place : Place::Across;
    }
    return place;
}

/// Returns false if the area has none of the face's pixels.
FRUSTUMSCREEN_INLINE bool set_area(BlockItem& item, const Sides& sides, const PixelRectangle& lit) {
    constexpr float slack = 0.05F; // pixels: cells are drawn wider by `grown` (cell_row.h)
    const auto first = [](float at, float least) {
        return static_cast<int>(std::floor(std::max(at - slack, least)));
    };
    const auto end = [](float at, float most) {
        return static_cast<int>(std::floor(std::min(at + slack, most))) + 1;
    };
    const int left = std::max(lit.x, first(sides.left, everywhere.left));
    const int right = std::min(lit.x + lit.width, end(sides.right, everywhere.right));
    const int top = std::max(lit.y, first(sides.top, everywhere.top));
    const int bottom = std::min(lit.y + lit.height, end(sides.bottom, everywhere.bottom));
    if (left >= right || top >= bottom) {
        return false;
    }
    item.area = {.left = static_cast<std::uint16_t>(left),
                 .right = static_cast<std::uint16_t>(right),
                 .top = static_cast<std::uint16_t>(top),
                 .bottom = static_cast<std::uint16_t>(bottom)};
    return true;
}

/// The box's range of distances from the eye, in texels.
struct Range {
    float near = 0.0F, bins_per_texel = 0.0F;
};

Range range_of(const RasterView& view, double texel_box) {
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

/// Lists one block, in the pixels of every face that may show it.
FRUSTUMSCREEN_INLINE void list_block(std::vector<BlockItem>& list, const BlockItems& items,
                                     const RasterView& view, const ReliefBlock& block, BlockItem item) {
    for (std::size_t f = 0; f < view.faces.size(); ++f) {
        const Bounds bounds = bounds_of(block, items.grids[f][item.direction], view.faces[f], items.lens);
        const Place place = place_of(bounds, view.faces[f]);
        item.face = static_cast<std::uint8_t>(f);
        item.inside = place == Place::Inside;
        item.nearest = bounds.nearest;
        if (place != Place::Outside && set_area(item, bounds.lit, view.faces[f].lit)) {
            list.push_back(item);
        }
        if (item.inside) {
            break; // faces share no pixels
        }
    }
}

/// The bands of rows that the item's area meets: first, and one past the last.
std::array<std::size_t, 2> bands_of(const BlockItem& item) {
    return {item.area.top / std::size_t{rows_of_band},
            (item.area.bottom + std::size_t{rows_of_band} - 1) / rows_of_band};
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

FRUSTUMSCREEN_INLINE void list(BlockItems& items, const BlockRelief& relief, const RasterView& view,
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
        if (!may_face(block, eye, items.facing)) {
            continue;
        }
        BlockItem item;
        item.block = static_cast<std::uint32_t>(k);
        item.direction = static_cast<std::uint8_t>(direction);
        item.bin = bin_of(block, eye, range);
        list_block(list, items, view, block, item);
    }
}

} // namespace

void begin_list(BlockItems& items, const BlockRelief& relief, const RasterView& view, Facing facing) {
    items.facing = facing;
    items.lens = PixelLens(view.projector);
    items.grids.resize(view.faces.size());
    for (std::size_t f = 0; f < view.faces.size(); ++f) {
        for (std::size_t d = 0; d < relief.grids.size(); ++d) {
            items.grids[f][d] = grid_view(relief.grids[d], static_cast<double>(relief.texel_box),
                                          view.faces[f], view.eye_box);
        }
    }
    items.parts.resize((relief.blocks.size() + blocks_of_part - 1) / blocks_of_part);
}

void list_part(BlockItems& items, const BlockRelief& relief, const RasterView& view, std::size_t part,
               Instructions instructions) {
    run_with<list>(instructions, items, relief, view, part);
}

/// Sorts by bins; within a bin the order of the blocks stays.
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

void list_blocks(BlockItems& items, const BlockRelief& relief, const RasterView& view,
                 Instructions instructions, Facing facing) {
    begin_list(items, relief, view, facing);
    for (std::size_t part = 0; part < items.parts.size(); ++part) {
        list_part(items, relief, view, part, instructions);
    }
    end_list(items);
}

} // namespace frustumscreen::relief
