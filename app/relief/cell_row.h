/// A row of a block's eight cells in a face's picture: the pixels that they cover, with positions and
/// nearness.
///
/// Frames   pixels of the projector's picture; positions in cells of the block.
/// Method   micropolygons (Cook 1987): most cells are smaller than a few pixels, so a cell's two triangles are tested
///          at the pixels around it, eight cells at once, one per lane. Nearness is linear over a triangle of the
///          picture; so is the position in a cell, unless its corners' distances from the eye differ by more
///          than `max_linear_ratio`.
/// Threads  pure; any. Inlined into one function for each instruction set; see item_rows.h.
#pragma once

#include "app/relief/block_items.h"
#include "app/relief/lanes.h"

#include <glm/glm.hpp>

#include <array>

namespace frustumscreen::relief {

static_assert(lanes == block_cells);

/// The block's corners, in pixels of the ideal pinhole: (x t, y t, t) = origin + column * i + row * j + code
/// * residual code.
struct CornerMap {
    std::array<float, 3> origin{}, column{}, row{}, code{};
};

FRUSTUMSCREEN_INLINE CornerMap corner_map(const ReliefBlock& block, const GridView& grid) {
    CornerMap map;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec4& of = grid.pixel[k];
        map.origin[k] = of.x * block.u0 + of.y * block.v0 + of.z * (block.w0 + block.residual_low) + of.w;
        map.column[k] = of.x + of.z * block.w_u;
        map.row[k] = of.y + of.z * block.w_v;
        map.code[k] = of.z * block.residual_step;
    }
    return map;
}

/// One corner of each cell.
struct Corners {
    Floats x, y;     ///< pixel
    Floats nearness; ///< 1 / t; not positive if not in front of the eye
};

FRUSTUMSCREEN_INLINE Corners corners_at(const CornerMap& map, Floats column, int row, Ints code) {
    const Floats codes = __builtin_convertvector(code, Floats);
    const auto at = [&](std::size_t k) FRUSTUMSCREEN_INLINED {
        return (map.origin[k] + static_cast<float>(row) * map.row[k]) + column * map.column[k] +
               codes * map.code[k];
    };
    const Floats nearness = 1.0F / at(2);
    return {at(0) * nearness, at(1) * nearness, nearness};
}

/// Corners (0, 0), (1, 0), (0, 1), (1, 1) of each cell.
struct CellCorners {
    Corners a, b, c, d;
};

/// Coordinates of a point in a cell's two triangles: along the edges from corner a towards b and c, and along
/// those from d towards c and b.
struct Weights {
    Floats to_b, to_c;
    Floats from_d_to_c, from_d_to_b;

    FRUSTUMSCREEN_INLINE Weights plus(const Weights& step) const {
        return {.to_b = to_b + step.to_b,
                .to_c = to_c + step.to_c,
                .from_d_to_c = from_d_to_c + step.from_d_to_c,
                .from_d_to_b = from_d_to_b + step.from_d_to_b};
    }
    FRUSTUMSCREEN_INLINE Weights times(Floats factor) const {
        return {.to_b = to_b * factor,
                .to_c = to_c * factor,
                .from_d_to_c = from_d_to_c * factor,
                .from_d_to_b = from_d_to_b * factor};
    }
};

struct CellRow {
    Ints there;                     ///< cells that face the eye
    Ints first_faces, second_faces; ///< the triangle at a, and the one at d, faces the eye
    bool recedes;                   ///< some cell by more than `max_linear_ratio`
    Floats left, right, top, bottom;
};

/// The distance of a cell's farthest corner from the eye over that of its nearest, up to which perspective moves positions in the cell
/// by less than 2 % of it.
constexpr float max_linear_ratio = 1.06F;

/// For the cells in `cells`. `outward` is 1 or -1: the grid's orientation in the picture.
FRUSTUMSCREEN_INLINE CellRow cell_row(const CellCorners& at, Ints cells, float outward) {
    const auto& [a, b, c, d] = at;
    const Floats first_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const Floats second_area = (c.x - d.x) * (b.y - d.y) - (c.y - d.y) * (b.x - d.x);
    constexpr float min_area = 1e-6F; // pixels
    const Ints first_faces = outward * first_area > min_area;
    const Ints second_faces = outward * second_area > min_area;
    const Ints there = cells & (first_faces | second_faces);
    const Floats farthest = least(least(a.nearness, b.nearness), least(c.nearness, d.nearness));
    const Floats nearest = most(most(a.nearness, b.nearness), most(c.nearness, d.nearness));
    return {.there = there,
            .first_faces = first_faces,
            .second_faces = second_faces,
            .recedes = any(there & (nearest > max_linear_ratio * farthest)),
            .left = least(least(a.x, b.x), least(c.x, d.x)),
            .right = most(most(a.x, b.x), most(c.x, d.x)),
            .top = least(least(a.y, b.y), least(c.y, d.y)),
            .bottom = most(most(a.y, b.y), most(c.y, d.y))};
}

/// Change of the weights from pixel to pixel.
struct CellSteps {
    Weights along_x, along_y;
};

FRUSTUMSCREEN_INLINE CellSteps cell_steps(const CellCorners& at) {
    const auto& [a, b, c, d] = at;
    const Floats ab_x = b.x - a.x, ab_y = b.y - a.y, ac_x = c.x - a.x, ac_y = c.y - a.y;
    const Floats dc_x = c.x - d.x, dc_y = c.y - d.y, db_x = b.x - d.x, db_y = b.y - d.y;
    const Floats first = 1.0F / (ab_x * ac_y - ab_y * ac_x);
    const Floats second = 1.0F / (dc_x * db_y - dc_y * db_x);
    return {{ac_y * first, -ab_y * first, db_y * second, -dc_y * second},
            {-ac_x * first, ab_x * first, -db_x * second, dc_x * second}};
}

/// Cells are drawn wider by this, so that blocks with different residual steps leave no gap.
constexpr float seam = 0.04F;  // cells
constexpr float grown = 0.02F; // pixels at most
/// A small overlap of a cell's two triangles, so that rounding leaves no gap between them.
constexpr float diagonal = 1.001F;

/// Pixels [left, right) x [top, bottom) whose sample each cell may cover.
struct CellPixels {
    Ints there; ///< cells that have any pixels
    Ints left, right, top, bottom;
};

/// `sample` is relative to a pixel's corner.
FRUSTUMSCREEN_INLINE CellPixels cell_pixels(const CellRow& row, const PixelSpan& limits,
                                            const glm::vec2& sample) {
    constexpr float before = 1.0F - grown;
    constexpr float after = 1.0F + grown;
    const auto whole = [](Floats pixel, int low, int high) FRUSTUMSCREEN_INLINED {
        return __builtin_convertvector(
            least(most(pixel, all(static_cast<float>(low))), all(static_cast<float>(high))), Ints);
    };
    CellPixels pixels;
    pixels.left = whole(row.left + (before - sample.x), limits.left, limits.right);
    pixels.right = whole(row.right + (after - sample.x), limits.left, limits.right);
    pixels.top = whole(row.top + (before - sample.y), limits.top, limits.bottom);
    pixels.bottom = whole(row.bottom + (after - sample.y), limits.top, limits.bottom);
    pixels.there = row.there & (pixels.left < pixels.right) & (pixels.top < pixels.bottom);
    return pixels;
}

struct Fragment {
    Ints met;
    Floats u, v; ///< in the cell
    Floats nearness;
};

FRUSTUMSCREEN_INLINE Fragment fragment_at(const CellRow& row, const CellCorners& at, const Weights& weights) {
    const auto& [to_b, to_c, from_d_to_c, from_d_to_b] = weights;
    const Ints first = row.first_faces & (to_b >= -seam) & (to_c >= -seam) & (to_b + to_c <= 1.0F);
    const Ints second = row.second_faces & (from_d_to_c >= -seam) & (from_d_to_b >= -seam) &
                        (from_d_to_c + from_d_to_b <= diagonal);
    const Floats a = at.a.nearness, b = at.b.nearness, c = at.c.nearness, d = at.d.nearness;
    const Floats nearness =
        first ? a + to_b * (b - a) + to_c * (c - a) : d + from_d_to_c * (c - d) + from_d_to_b * (b - d);
    Floats towards_b = first ? to_b : from_d_to_b;
    Floats towards_c = first ? to_c : from_d_to_c;
    if (row.recedes) { // each corner weighs by its nearness
        towards_b *= b / nearness;
        towards_c *= c / nearness;
    }
    return {.met = first | second,
            .u = first ? towards_b : 1.0F - towards_c,
            .v = first ? towards_c : 1.0F - towards_b,
            .nearness = nearness};
}

/// Columns, counted from where the weights are; real, so that none lie between `first` and a smaller `last`.
struct Columns {
    Floats first, last;

    /// The columns among these at which a linear function that changes by `slope` a column is not negative.
    FRUSTUMSCREEN_INLINE Columns where(Floats function, Floats slope) const {
        const Floats zero = -function / slope;
        return {slope > 0.0F ? most(first, zero) : first, slope < 0.0F ? least(last, zero) : last};
    }
};

/// The columns among the first `count` of a row of pixels that a cell's triangles cover (fragment_at). `weights`: at
/// the first one.
FRUSTUMSCREEN_INLINE Columns covered_columns(const CellRow& row, const Weights& weights, const Weights& step,
                                             Floats count) {
    const Columns every{Floats{}, count - 1.0F};
    const Columns first = every.where(weights.to_b + seam, step.to_b)
                              .where(weights.to_c + seam, step.to_c)
                              .where(1.0F - weights.to_b - weights.to_c, -step.to_b - step.to_c);
    const Columns second = every.where(weights.from_d_to_c + seam, step.from_d_to_c)
                               .where(weights.from_d_to_b + seam, step.from_d_to_b)
                               .where(diagonal - weights.from_d_to_c - weights.from_d_to_b,
                                      -step.from_d_to_c - step.from_d_to_b);
    const Ints in_first = row.first_faces & (first.first <= first.last);
    const Ints in_second = row.second_faces & (second.first <= second.last);
    return {least(in_first ? first.first : count, in_second ? second.first : count),
            most(in_first ? first.last : all(-1.0F), in_second ? second.last : all(-1.0F))};
}

/// Calls visit(weights, lanes, columns, row) for the `sample` of the pixels (left + column, top + row) of all
/// cells. The number of steps is found first, because a loop that asks in every step whether any lane
/// continues stalls on the answer.
///
/// An eye just before the plane of a face sees each cell drawn out across it: a sliver along the diagonal of its box. So each
/// row of a wide box begins and ends where the cell does.
template <typename Visit>
FRUSTUMSCREEN_INLINE void for_each_pixel(const CellPixels& pixels, const CellRow& row, const CellCorners& at,
                                         const CellSteps& steps, const glm::vec2& sample,
                                         const Visit& visit) {
    const auto& [along_x, along_y] = steps;
    const Floats left = __builtin_convertvector(pixels.left, Floats) + sample.x;
    const Floats top = __builtin_convertvector(pixels.top, Floats) + sample.y;
    const Floats from_a_x = left - at.a.x, from_a_y = top - at.a.y;
    const Floats from_d_x = left - at.d.x, from_d_y = top - at.d.y;
    Weights begin = {.to_b = from_a_x * along_x.to_b + from_a_y * along_y.to_b,
                     .to_c = from_a_x * along_x.to_c + from_a_y * along_y.to_c,
                     .from_d_to_c = from_d_x * along_x.from_d_to_c + from_d_y * along_y.from_d_to_c,
                     .from_d_to_b = from_d_x * along_x.from_d_to_b + from_d_y * along_y.from_d_to_b};
    const Ints columns = pixels.there & (pixels.right - pixels.left);
    const Ints rows = pixels.there & (pixels.bottom - pixels.top);
    const int max_columns = max_of(columns);
    const int max_rows = max_of(rows);
    constexpr int wide = 8; // below this, finding a row's ends costs more than it saves
    for (int y = 0; y < max_rows; ++y) {
        const Ints in_y = y < rows;
        Weights weights = begin;
        Ints first{};
        Ints count = columns;
        int max_count = max_columns;
        if (max_columns > wide) {
            const Columns covered =
                covered_columns(row, begin, along_x, __builtin_convertvector(columns, Floats));
            first = __builtin_convertvector(covered.first, Ints);
            count = in_y & (__builtin_convertvector(covered.last, Ints) + 1 - first);
            max_count = max_of(count);
            weights = begin.plus(along_x.times(__builtin_convertvector(first, Floats)));
        }
        for (int x = 0; x < max_count; ++x) {
            visit(weights, in_y & (x < count), first + x, y);
            weights = weights.plus(along_x);
        }
        begin = begin.plus(along_y);
    }
}

} // namespace frustumscreen::relief
