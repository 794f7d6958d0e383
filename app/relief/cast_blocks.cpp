#include "app/relief/cast_blocks.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace frustumscreen {

namespace {

constexpr int lanes = tile_width * tile_height;
using Floats = float __attribute__((vector_size(4 * lanes)));
using Ints = std::int32_t __attribute__((vector_size(4 * lanes)));

/// Everything below is inlined into one function for each instruction set.
#define FRUSTUMSCREEN_INLINE [[gnu::always_inline]] inline

FRUSTUMSCREEN_INLINE Floats all(float value) {
    return Floats{} + value;
}
FRUSTUMSCREEN_INLINE Floats least(Floats a, Floats b) {
    return a < b ? a : b;
}
FRUSTUMSCREEN_INLINE Floats most(Floats a, Floats b) {
    return a > b ? a : b;
}
FRUSTUMSCREEN_INLINE bool any(Ints mask) {
    std::array<std::uint64_t, lanes / 2> words;
    std::memcpy(words.data(), &mask, sizeof mask);
    return (words[0] | words[1] | words[2] | words[3]) != 0;
}
FRUSTUMSCREEN_INLINE Floats load(const float* from) {
    Floats value;
    std::memcpy(&value, from, sizeof value);
    return value;
}
template <typename Vector, typename Word> FRUSTUMSCREEN_INLINE void store(Word* to, Vector value) {
    static_assert(sizeof(Vector) == lanes * sizeof(Word));
    std::memcpy(to, &value, sizeof value);
}

/// The eight rays of a tile from one block's corner, in its grid: the eye at (u, v), the height of the eye above the block's plane,
/// and what each ray adds to them.
struct Rays {
    Floats du, dv;
    Floats fall; ///< what the height above the plane changes by along the ray
    float u, v, height;
};

/// A block, ready for its tiles.
struct Surface {
    const std::uint32_t* codes;
    Ints mask_low, mask_high;
    Floats low, step;
    bool full;
};

struct Local {
    Floats u, v;
};

FRUSTUMSCREEN_INLINE Local place_on(const Rays& rays, Floats t) {
    return {rays.u + t * rays.du, rays.v + t * rays.dv};
}

constexpr float last_cell = block_cells - 0.0005F;

/// The residual at a place, and what it changes by along the ray.
struct Residual {
    Floats value, along;
};

FRUSTUMSCREEN_INLINE Residual residual_at(const Surface& surface, const Rays& rays, Local at) {
    const Floats u = least(most(at.u, Floats{}), all(last_cell));
    const Floats v = least(most(at.v, Floats{}), all(last_cell));
    const Ints column = __builtin_convertvector(u, Ints);
    const Ints row = __builtin_convertvector(v, Ints);
    const Floats fu = u - __builtin_convertvector(column, Floats);
    const Floats fv = v - __builtin_convertvector(row, Floats);
    const Ints cell = row * block_cells + column;
    Ints codes;
    for (int lane = 0; lane < lanes; ++lane) {
        codes[lane] = static_cast<std::int32_t>(surface.codes[cell[lane]]);
    }
    const Floats a = __builtin_convertvector(codes & 255, Floats);
    const Floats b = __builtin_convertvector((codes >> 8) & 255, Floats);
    const Floats c = __builtin_convertvector((codes >> 16) & 255, Floats);
    const Floats d = __builtin_convertvector((codes >> 24) & 255, Floats);
    const Floats low_slope = b - a;
    const Floats high_slope = d - c;
    const Floats low = a + fu * low_slope;
    const Floats rise = c + fu * high_slope - low;
    return {surface.low + surface.step * (low + fv * rise),
            surface.step * ((low_slope + fv * (high_slope - low_slope)) * rays.du + rise * rays.dv)};
}

/// Whether the place is in a cell that is there. A hit on a seam may land a little beside both.
FRUSTUMSCREEN_INLINE Ints in_cells(const Surface& surface, Local at) {
    constexpr float seam = 0.04F; // cells
    const Ints within =
        (at.u >= -seam) & (at.u <= block_cells + seam) & (at.v >= -seam) & (at.v <= block_cells + seam);
    if (surface.full) {
        return within;
    }
    const Ints column = __builtin_convertvector(least(most(at.u, Floats{}), all(last_cell)), Ints);
    const Ints row = __builtin_convertvector(least(most(at.v, Floats{}), all(last_cell)), Ints);
    const Ints word = row > 3 ? surface.mask_high : surface.mask_low;
    const Ints bit = (word >> ((row & 3) * block_cells + column)) & 1;
    return within & (bit != 0);
}

struct Meeting {
    Floats t;
    Ints met;
};

/// From where the rays meet the block's plane.
FRUSTUMSCREEN_INLINE Meeting by_newton(const Surface& surface, const Rays& rays, Floats t, Ints live,
                                       int steps) {
    for (int k = 0; k < steps; ++k) {
        const Residual residual = residual_at(surface, rays, place_on(rays, t));
        t -= (rays.height + t * rays.fall - residual.value) / (rays.fall - residual.along);
    }
    return {t, live & in_cells(surface, place_on(rays, t))};
}

/// In steps of about a cell from `t` to `end`; the first crossing inwards in a cell that is there.
FRUSTUMSCREEN_INLINE Meeting by_march(const Surface& surface, const Rays& rays, Floats t, Floats end,
                                      Ints live) {
    const Floats across = (end - t) * most(most(rays.du, -rays.du), most(rays.dv, -rays.dv));
    float longest = 0.0F;
    for (int lane = 0; lane < lanes; ++lane) {
        longest = live[lane] != 0 ? std::max(longest, across[lane]) : longest;
    }
    constexpr int most_steps = 24;
    const int steps = std::min(most_steps, 1 + static_cast<int>(1.1F * longest));
    const Floats step = (end - t) / static_cast<float>(steps);
    Meeting meeting{t, Ints{}};
    Floats above = rays.height + t * rays.fall - residual_at(surface, rays, place_on(rays, t)).value;
    for (int k = 0; k < steps && any(live); ++k) {
        const Floats next = t + step;
        const Floats then =
            rays.height + next * rays.fall - residual_at(surface, rays, place_on(rays, next)).value;
        Ints crosses = live & (above >= 0.0F) & (then < 0.0F);
        if (any(crosses)) {
            const Floats at = t + step * (above / (above - then));
            crosses &= in_cells(surface, place_on(rays, at));
            meeting.t = crosses ? at : meeting.t;
            meeting.met |= crosses;
            live &= ~crosses;
        }
        t = next;
        above = then;
    }
    return meeting;
}

/// What the block's extent leaves of the rays.
struct Slab {
    float u_low, u_high, v_low, v_high, low, high;
};

FRUSTUMSCREEN_INLINE void narrow(Floats& begin, Floats& end, Floats rate, float low, float high) {
    const Floats a = low / rate;
    const Floats b = high / rate;
    begin = most(begin, least(a, b));
    end = least(end, most(a, b));
}

/// A tile's rays in the grid, of the pixel of its first lane.
struct TileRays {
    Floats x, y;
    const GridView& grid;

    FRUSTUMSCREEN_INLINE Floats along(std::size_t k) const {
        const glm::vec3& ray = grid.ray[k];
        return ray.x * x + ray.y * y + ray.z;
    }
};

FRUSTUMSCREEN_INLINE Ints in_face(const CastFace& face, Floats x, Floats y) {
    Ints inside = Ints{} - 1;
    for (const glm::dvec3& edge : face.edges) {
        inside &=
            static_cast<float>(edge.x) * x + static_cast<float>(edge.y) * y + static_cast<float>(edge.z) >
            0.0F;
    }
    return inside;
}

FRUSTUMSCREEN_INLINE void cast_item(CastPicture& picture, const BlockRelief& relief, const CastView& view,
                                    const BlockItems& items, const BlockItem& item, TileBand band) {
    const ReliefBlock& block = relief.blocks[item.block];
    const GridView& grid = items.grids[item.face][item.direction];
    const Surface surface{&relief.corner_codes[std::size_t{item.block} * block_cells * block_cells],
                          Ints{} + static_cast<std::int32_t>(static_cast<std::uint32_t>(block.mask)),
                          Ints{} + static_cast<std::int32_t>(static_cast<std::uint32_t>(block.mask >> 32U)),
                          all(block.residual_low),
                          all(block.residual_step),
                          block.mask == ~std::uint64_t{0}};
    Rays rays{};
    rays.u = grid.eye.x - block.u0;
    rays.v = grid.eye.y - block.v0;
    rays.height = grid.eye.z - block.w0 - block.w_u * rays.u - block.w_v * rays.v;
    const Slab cells{block.cells[0] - rays.u,
                     block.cells[1] - rays.u,
                     block.cells[2] - rays.v,
                     block.cells[3] - rays.v,
                     0.0F,
                     0.0F};
    constexpr float slack = 0.04F; // cells
    const Floats lane_x = {0.5F, 1.5F, 2.5F, 3.5F, 0.5F, 1.5F, 2.5F, 3.5F};
    const Floats lane_y = {0.5F, 0.5F, 0.5F, 0.5F, 1.5F, 1.5F, 1.5F, 1.5F};
    const int first_row = std::max<int>(item.first_row, band.first);
    const int end_row = std::min<int>(item.end_row, band.end);
    for (int row = first_row; row < end_row; ++row) {
        std::size_t at =
            (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.columns) + item.first_column) *
            lanes;
        const Floats y = lane_y + static_cast<float>(row * tile_height);
        for (int column = item.first_column; column < item.end_column; ++column, at += lanes) {
            const Floats x = lane_x + static_cast<float>(column * tile_width);
            const TileRays tile{x, y, grid};
            rays.du = tile.along(0);
            rays.dv = tile.along(1);
            rays.fall = tile.along(2) - block.w_u * rays.du - block.w_v * rays.dv;
            const Floats before = load(&picture.t[at]);
            Floats t;
            Floats end{};
            Ints live;
            if (item.search != Search::March) {
                t = -rays.height / rays.fall;
                const Floats u = t * rays.du;
                const Floats v = t * rays.dv;
                live = (u >= cells.u_low - item.reach) & (u <= cells.u_high + item.reach) &
                       (v >= cells.v_low - item.reach) & (v <= cells.v_high + item.reach);
            } else {
                t = Floats{};
                end = before;
                narrow(t, end, rays.du, cells.u_low - slack, cells.u_high + slack);
                narrow(t, end, rays.dv, cells.v_low - slack, cells.v_high + slack);
                narrow(t, end, rays.fall, block.residual_low - slack - rays.height,
                       block.residual_high() + slack - rays.height);
                live = t < end;
            }
            if (!item.inside) {
                live &= in_face(view.faces[item.face], x, y);
            }
            if (!any(live)) {
                continue;
            }
            const Meeting meeting =
                item.search == Search::March
                    ? by_march(surface, rays, t, end, live)
                    : by_newton(surface, rays, t, live, 1 + static_cast<int>(item.search));
            const Ints nearer = meeting.met & (meeting.t < before) & (meeting.t > 0.0F);
            if (!any(nearer)) {
                continue;
            }
            store(&picture.t[at], nearer ? meeting.t : before);
            const Local place = place_on(rays, meeting.t);
            constexpr auto scale = static_cast<float>(CastPicture::places_per_cell);
            const Ints u =
                __builtin_convertvector(least(most(place.u, Floats{}), all(block_cells)) * scale, Ints);
            const Ints v =
                __builtin_convertvector(least(most(place.v, Floats{}), all(block_cells)) * scale, Ints);
            const Ints packed = u | (v << 16);
            for (int lane = 0; lane < lanes; ++lane) {
                if (nearer[lane] != 0) {
                    picture.block[at + static_cast<std::size_t>(lane)] = item.block;
                    picture.place[at + static_cast<std::size_t>(lane)] =
                        static_cast<std::uint32_t>(packed[lane]);
                }
            }
        }
    }
}

FRUSTUMSCREEN_INLINE void cast_all(CastPicture& picture, const BlockRelief& relief, const CastView& view,
                                   const BlockItems& items, TileBand band) {
    for (const BlockItem& item : items.sorted) {
        if (item.first_row < band.end && item.end_row > band.first) {
            cast_item(picture, relief, view, items, item, band);
        }
    }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void cast_with_avx2(CastPicture& picture, const BlockRelief& relief,
                                            const CastView& view, const BlockItems& items, TileBand band) {
    cast_all(picture, relief, view, items, band);
}
#endif

void cast_plainly(CastPicture& picture, const BlockRelief& relief, const CastView& view,
                  const BlockItems& items, TileBand band) {
    cast_all(picture, relief, view, items, band);
}

} // namespace

void CastPicture::resize(int width, int height) {
    columns = (width + tile_width - 1) / tile_width;
    rows = (height + tile_height - 1) / tile_height;
    const std::size_t pixels = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * lanes;
    t.assign(pixels, std::numeric_limits<float>::infinity());
    block.assign(pixels, 0);
    place.assign(pixels, 0);
}

void cast(CastPicture& picture, const BlockRelief& relief, const CastView& view, const BlockItems& items,
          TileBand band) {
    const int left = view.lit.x / tile_width;
    const int right = std::min((view.lit.x + view.lit.width + tile_width - 1) / tile_width, picture.columns);
    for (int row = band.first; row < band.end && left < right; ++row) {
        const std::size_t begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.columns);
        std::fill_n(&picture.t[(begin + static_cast<std::size_t>(left)) * lanes],
                    static_cast<std::size_t>(right - left) * lanes, std::numeric_limits<float>::infinity());
    }
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) {
        cast_with_avx2(picture, relief, view, items, band);
        return;
    }
#endif
    cast_plainly(picture, relief, view, items, band);
}

glm::u8vec4 colour_at(const BlockRelief& relief, std::uint32_t block, std::uint32_t place) {
    constexpr std::uint32_t unit = CastPicture::places_per_cell;
    constexpr std::uint32_t end = block_cells * unit - 1;
    const std::uint32_t u = std::min(place & 0xFFFFU, end);
    const std::uint32_t v = std::min(place >> 16U, end);
    const std::uint32_t fu = u % unit;
    const std::uint32_t fv = v % unit;
    const glm::u8vec4* const corner = &relief.colours[std::size_t{block} * block_corners * block_corners +
                                                      (v / unit) * block_corners + u / unit];
    glm::u8vec4 colour;
    for (int channel = 0; channel < 4; ++channel) {
        const std::uint32_t low = corner[0][channel] * (unit - fu) + corner[1][channel] * fu;
        const std::uint32_t high =
            corner[block_corners][channel] * (unit - fu) + corner[block_corners + 1][channel] * fu;
        colour[channel] =
            static_cast<std::uint8_t>((low * (unit - fv) + high * fv + unit * unit / 2) / (unit * unit));
    }
    return colour;
}

} // namespace frustumscreen
