#include "app/relief/rasterize_nearness.h"

#include "app/relief/item_rows.h"

#include <array>
#include <bit>
#include <cstdint>

namespace frustumscreen::relief {

namespace {

/// The linear functions of the picture over a cell: the weights of its two triangles, and the nearness over each.
struct CellPlanes {
    Weights weights;
    Floats first_nearness, second_nearness;

    FRUSTUMSCREEN_INLINE CellPlanes plus(const CellPlanes& step) const {
        return {weights.plus(step.weights), first_nearness + step.first_nearness,
                second_nearness + step.second_nearness};
    }
};

/// Eight numbers of eight cells, to take one cell's from.
class Stored {
public:
    FRUSTUMSCREEN_INLINE void keep(const CellPlanes& planes) {
        store(&at_[0][0], planes.weights.to_b);
        store(&at_[1][0], planes.weights.to_c);
        store(&at_[2][0], planes.weights.from_d_to_c);
        store(&at_[3][0], planes.weights.from_d_to_b);
        store(&at_[4][0], planes.first_nearness);
        store(&at_[5][0], planes.second_nearness);
    }
    /// The cell's in all lanes.
    FRUSTUMSCREEN_INLINE CellPlanes of(std::size_t cell) const {
        const auto one = [&](std::size_t k) FRUSTUMSCREEN_INLINED { return all(at_[k][cell]); };
        return {{one(0), one(1), one(2), one(3)}, one(4), one(5)};
    }

private:
    std::array<std::array<float, lanes>, 6> at_;
};

FRUSTUMSCREEN_INLINE CellPlanes times(const CellPlanes& planes, Floats factor) {
    const auto& [to_b, to_c, from_d_to_c, from_d_to_b] = planes.weights;
    return {{to_b * factor, to_c * factor, from_d_to_c * factor, from_d_to_b * factor},
            planes.first_nearness * factor,
            planes.second_nearness * factor};
}

/// The changes by a step in the picture.
FRUSTUMSCREEN_INLINE CellPlanes steps_of(const Weights& step, const CellCorners& at) {
    const Floats a = at.a.nearness, b = at.b.nearness, c = at.c.nearness, d = at.d.nearness;
    return {step, step.to_b * (b - a) + step.to_c * (c - a),
            step.from_d_to_c * (c - d) + step.from_d_to_b * (b - d)};
}

/// At the centres of the pixels (x, y). A triangle that is turned away is nowhere.
FRUSTUMSCREEN_INLINE CellPlanes planes_at(const CellRow& row, const CellCorners& at, const CellSteps& steps,
                                          Floats x, Floats y) {
    const auto& [along_x, along_y] = steps;
    constexpr float nowhere = -1e30F;
    const Floats a_x = x - at.a.x, a_y = y - at.a.y, d_x = x - at.d.x, d_y = y - at.d.y;
    const Weights weights{.to_b = a_x * along_x.to_b + a_y * along_y.to_b,
                          .to_c = a_x * along_x.to_c + a_y * along_y.to_c,
                          .from_d_to_c = d_x * along_x.from_d_to_c + d_y * along_y.from_d_to_c,
                          .from_d_to_b = d_x * along_x.from_d_to_b + d_y * along_y.from_d_to_b};
    CellPlanes planes = steps_of(weights, at);
    planes.first_nearness += at.a.nearness;
    planes.second_nearness += at.d.nearness;
    planes.weights.to_b = row.first_faces ? planes.weights.to_b : all(nowhere);
    planes.weights.from_d_to_c = row.second_faces ? planes.weights.from_d_to_c : all(nowhere);
    return planes;
}

struct Hits {
    Ints first, second; ///< in the triangle at a, in the one at d
    FRUSTUMSCREEN_INLINE Ints both() const { return first | second; }
};

/// As fragment_at (cell_row.h).
FRUSTUMSCREEN_INLINE Hits hits_of(const Weights& weights) {
    const auto& [to_b, to_c, from_d_to_c, from_d_to_b] = weights;
    return {(to_b >= -seam) & (to_c >= -seam) & (to_b + to_c <= 1.0F),
            (from_d_to_c >= -seam) & (from_d_to_b >= -seam) & (from_d_to_c + from_d_to_b <= diagonal)};
}

/// The hits at which a cut cell exists.
FRUSTUMSCREEN_INLINE Ints covered(const Hits& hits, const Weights& weights, std::uint64_t cover) {
    const auto part = [](Floats at) FRUSTUMSCREEN_INLINED {
        return __builtin_convertvector(least(most(at * 8.0F, Floats{}), all(7.0F)), Ints);
    };
    const Ints place = part(hits.first ? weights.to_c : 1.0F - weights.from_d_to_b) * 8 +
                       part(hits.first ? weights.to_b : 1.0F - weights.from_d_to_c);
    Ints there{};
    for (int lane = 0; lane < lanes; ++lane) {
        there[lane] = (cover >> static_cast<unsigned>(place[lane]) & 1U) != 0 ? -1 : 0;
    }
    return hits.both() & there;
}

/// One cell's pixels.
struct CellBox {
    int left, right, top, bottom;
};

template <bool is_cut>
FRUSTUMSCREEN_INLINE void draw_cell(const PictureSpan<float>& nearness, const CellBox& box,
                                    const CellPlanes& begin, const CellPlanes& along_x,
                                    const CellPlanes& along_y, std::uint64_t cover) {
    constexpr Floats columns = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F};
    for (int left = box.left; left < box.right; left += lanes) {
        const int first = std::min(left, nearness.width - lanes); // eight pixels of the same row
        const Ints inside = (lane_numbers >= left - first) & (lane_numbers < box.right - first);
        CellPlanes planes = begin.plus(times(along_x, columns + static_cast<float>(first - box.left)));
        float* row = &nearness.at(first, box.top);
        for (int y = box.top; y < box.bottom; ++y, row += nearness.stride) {
            const Hits hits = hits_of(planes.weights);
            const Ints there = is_cut ? covered(hits, planes.weights, cover) : hits.both();
            const Floats near = hits.first ? planes.first_nearness : planes.second_nearness;
            store(row, most(load(row), (there & inside) ? near : Floats{}));
            planes = planes.plus(along_y);
        }
    }
}

struct AskedItem {
    const ReadyItem& ready;
    PixelSpan limits;
    bool wholly; ///< all tiles of its pixels are asked for
};

FRUSTUMSCREEN_INLINE void draw_cells(const PictureSpan<float>& nearness, const TileMask& asked,
                                     const AskedItem& item, const CellCorners& corners, Ints cells, int row) {
    const CellRow at = cell_row(corners, cells, item.ready.outward);
    constexpr glm::vec2 centre(0.5F);
    const CellPixels pixels = cell_pixels(at, item.limits, centre);
    unsigned there = bits_of(pixels.there);
    if (there == 0) {
        return;
    }
    const CellSteps steps = cell_steps(corners);
    Stored begin, along_x, along_y;
    begin.keep(planes_at(at, corners, steps, __builtin_convertvector(pixels.left, Floats) + centre.x,
                         __builtin_convertvector(pixels.top, Floats) + centre.y));
    along_x.keep(steps_of(steps.along_x, corners));
    along_y.keep(steps_of(steps.along_y, corners));
    const ReliefBlock& block = item.ready.block;
    for (; there != 0; there &= there - 1) {
        const int cell = std::countr_zero(there);
        const CellBox box{pixels.left[cell], pixels.right[cell], pixels.top[cell], pixels.bottom[cell]};
        if (!item.wholly && !asked.some({.x = box.left,
                                         .y = box.top,
                                         .width = box.right - box.left,
                                         .height = box.bottom - box.top})) {
            continue;
        }
        const auto of = static_cast<std::size_t>(cell);
        const std::uint64_t bit = std::uint64_t{1} << (row * block_cells + cell);
        if ((block.cut & bit) == 0) {
            draw_cell<false>(nearness, box, begin.of(of), along_x.of(of), along_y.of(of), 0);
        } else {
            draw_cell<true>(nearness, box, begin.of(of), along_x.of(of), along_y.of(of),
                            item.ready.covers[std::popcount(block.cut & (bit - 1))]);
        }
    }
}

/// True if all of the area's pixels already have something nearer.
FRUSTUMSCREEN_INLINE bool is_behind(const PictureSpan<float>& nearness, const PixelSpan& area,
                                    float nearest) {
    for (int y = area.top; y < area.bottom; ++y) {
        for (int left = area.left; left < area.right; left += lanes) {
            const int first = std::min(left, nearness.width - lanes);
            if (any((load(&nearness.at(first, y)) < nearest) & (lane_numbers >= left - first) &
                    (lane_numbers < area.right - first))) {
                return false;
            }
        }
    }
    return true;
}

FRUSTUMSCREEN_INLINE void draw_band(const PictureSpan<float>& nearness, const TileMask& asked,
                                    const int& band, const BlockRelief& relief, const RasterView& view,
                                    const BlockItems& items) {
    const PixelRectangle picture{.x = 0, .y = 0, .width = nearness.width, .height = nearness.height};
    for (const std::uint32_t place : items_of(items, band)) {
        const BlockItem& item = items.sorted[place];
        const PixelSpan limits = within(item.area, picture, band);
        const PixelRectangle area{.x = limits.left,
                                  .y = limits.top,
                                  .width = limits.right - limits.left,
                                  .height = limits.bottom - limits.top};
        if (area.empty() || !asked.some(area) || is_behind(nearness, limits, item.nearest)) {
            continue;
        }
        const ReadyItem ready_item = ready(relief, view, items, item, {});
        const AskedItem asked_item{ready_item, limits, asked.each(area)};
        for_each_row(ready_item, [&](const CellCorners& corners, Ints cells, int row) FRUSTUMSCREEN_INLINED {
            draw_cells(nearness, asked, asked_item, corners, cells, row);
        });
    }
}

FRUSTUMSCREEN_INLINE void divide_band(const PictureSpan<float>& nearness, const TileMask& asked,
                                      const int& band, const glm::vec3& slant) {
    static_assert(TileMask::tile_px == lanes);
    for (int y = band * rows_of_band; y < std::min((band + 1) * rows_of_band, nearness.height); ++y) {
        const float at_row = slant.y * (static_cast<float>(y) + 0.5F) + slant.z;
        for (std::uint64_t tiles = asked.tiles_at(y); tiles != 0; tiles &= tiles - 1) {
            const int first = std::countr_zero(tiles) * lanes;
            float* const eight = &nearness.at(first, y);
            const Floats x = __builtin_convertvector(lane_numbers + first, Floats) + 0.5F;
            store(eight, load(eight) / (slant.x * x + at_row));
        }
    }
}

} // namespace

void divide_by_slant(const PictureSpan<float>& nearness, const TileMask& asked, int band,
                     const glm::vec3& slant, Instructions instructions) {
    run_with<divide_band>(instructions, nearness, asked, band, slant);
}

void rasterize_nearness(const PictureSpan<float>& nearness, const TileMask& asked, int band,
                        const BlockRelief& relief, const RasterView& view, const BlockItems& items,
                        Instructions instructions) {
    run_with<draw_band>(instructions, nearness, asked, band, relief, view, items);
}

} // namespace frustumscreen::relief
