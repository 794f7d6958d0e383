#include "app/relief/cast_blocks.h"

#include "app/relief/block_surface.h"
#include "app/relief/lanes.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <span>

namespace frustumscreen {

namespace {

static_assert(lanes == tile_width * tile_height);

FRUSTUMSCREEN_INLINE Ints in_face(const CastFace& face, Floats x, Floats y) {
    Ints inside = Ints{} - 1;
    for (const glm::dvec3& edge : face.edges) {
        inside &=
            static_cast<float>(edge.x) * x + static_cast<float>(edge.y) * y + static_cast<float>(edge.z) >
            0.0F;
    }
    return inside;
}

/// What eight rays have met so far.
struct Hits {
    float* t;
    std::uint32_t* block;
    std::uint32_t* place;
};

/// An item, ready for any eight rays.
struct ReadyItem {
    const BlockItem& item;
    const ReliefBlock& block;
    const GridView& grid;
    const CastFace& face;
    Surface surface;
    Rays eye; ///< without what the rays add
};

FRUSTUMSCREEN_INLINE ReadyItem ready(const BlockRelief& relief, const CastView& view, const BlockItems& items,
                                     const BlockItem& item) {
    const ReliefBlock& block = relief.blocks[item.block];
    const GridView& grid = items.grids[item.face][item.direction];
    Rays eye{};
    eye.u = grid.eye.x - block.u0;
    eye.v = grid.eye.y - block.v0;
    eye.height = grid.eye.z - block.w0 - block.w_u * eye.u - block.w_v * eye.v;
    return {item,
            block,
            grid,
            view.faces[item.face],
            {&relief.corner_codes[std::size_t{item.block} * block_cells * block_cells],
             Ints{} + static_cast<std::int32_t>(static_cast<std::uint32_t>(block.mask)),
             Ints{} + static_cast<std::int32_t>(static_cast<std::uint32_t>(block.mask >> 32U)),
             all(block.residual_low), all(block.residual_step),
             block.mask == ~std::uint64_t{0} && block.cut == 0, block.cut,
             relief.covers.data() + block.first_cover},
            eye};
}

FRUSTUMSCREEN_INLINE Rays rays_of(const ReadyItem& ready, Floats x, Floats y) {
    const auto along = [&](std::size_t k) {
        const glm::vec3& ray = ready.grid.ray[k];
        return ray.x * x + ray.y * y + ray.z;
    };
    Rays rays = ready.eye;
    rays.du = along(0);
    rays.dv = along(1);
    rays.fall = along(2) - ready.block.w_u * rays.du - ready.block.w_v * rays.dv;
    return rays;
}

/// Where the rays through (x, y) meet the item's block nearer than `before`, if they do.
FRUSTUMSCREEN_INLINE Meeting meeting_of(const ReadyItem& ready, const Rays& rays, Floats x, Floats y,
                                        Floats before) {
    const ReliefBlock& block = ready.block;
    const float u_low = block.cells[0] - rays.u;
    const float u_high = block.cells[1] - rays.u;
    const float v_low = block.cells[2] - rays.v;
    const float v_high = block.cells[3] - rays.v;
    Meeting meeting{};
    Floats end{};
    if (ready.item.search != Search::March) {
        meeting.t = -rays.height / rays.fall;
        const Floats u = meeting.t * rays.du;
        const Floats v = meeting.t * rays.dv;
        const float reach = ready.item.reach;
        meeting.met = (u >= u_low - reach) & (u <= u_high + reach) & (v >= v_low - reach) &
                      (v <= v_high + reach) & (meeting.t * (1.0F - ready.item.early) < before);
    } else {
        constexpr float slack = 0.04F; // cells
        end = before;
        narrow(meeting.t, end, rays.du, u_low - slack, u_high + slack);
        narrow(meeting.t, end, rays.dv, v_low - slack, v_high + slack);
        narrow(meeting.t, end, rays.fall, block.residual_low - slack - rays.height,
               block.residual_high() + slack - rays.height);
        meeting.met = meeting.t < end;
    }
    if (!ready.item.inside) {
        meeting.met &= in_face(ready.face, x, y);
    }
    if (!any(meeting.met)) {
        return meeting;
    }
    meeting = ready.item.search == Search::March ? by_march(ready.surface, rays, meeting.t, end, meeting.met)
                                                 : by_newton(ready.surface, rays, meeting.t, meeting.met,
                                                             1 + static_cast<int>(ready.item.search));
    meeting.met &= (meeting.t < before) & (meeting.t > 0.0F);
    return meeting;
}

FRUSTUMSCREEN_INLINE void cast_eight(const ReadyItem& ready, Floats x, Floats y, const Hits& hits) {
    const Floats before = load(hits.t);
    const Rays rays = rays_of(ready, x, y);
    const Meeting meeting = meeting_of(ready, rays, x, y, before);
    if (!any(meeting.met)) {
        return;
    }
    store(hits.t, meeting.met ? meeting.t : before);
    const Local place = place_on(rays, meeting.t);
    constexpr auto scale = static_cast<float>(CastPicture::places_per_cell);
    const Ints u = __builtin_convertvector(least(most(place.u, Floats{}), all(block_cells)) * scale, Ints);
    const Ints v = __builtin_convertvector(least(most(place.v, Floats{}), all(block_cells)) * scale, Ints);
    const Ints packed = u | (v << 16);
    for (int lane = 0; lane < lanes; ++lane) {
        if (meeting.met[lane] != 0) {
            hits.block[lane] = ready.item.block;
            hits.place[lane] = static_cast<std::uint32_t>(packed[lane]);
        }
    }
}

FRUSTUMSCREEN_INLINE void cast_item(CastPicture& picture, const ReadyItem& ready, TileBand band) {
    const Floats lane_x = {0.5F, 1.5F, 2.5F, 3.5F, 0.5F, 1.5F, 2.5F, 3.5F};
    const Floats lane_y = {0.5F, 0.5F, 0.5F, 0.5F, 1.5F, 1.5F, 1.5F, 1.5F};
    const TileRectangle& tiles = ready.item.centres;
    const int end_row = std::min<int>(tiles.end_row, band.end);
    for (int row = std::max<int>(tiles.first_row, band.first); row < end_row; ++row) {
        std::size_t at =
            (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.columns) + tiles.first_column) *
            lanes;
        const Floats y = lane_y + static_cast<float>(row * tile_height);
        for (int column = tiles.first_column; column < tiles.end_column; ++column, at += lanes) {
            const Floats x = lane_x + static_cast<float>(column * tile_width);
            cast_eight(ready, x, y, {&picture.t[at], &picture.block[at], &picture.place[at]});
        }
    }
}

FRUSTUMSCREEN_INLINE void cast_item(CastRays& rays, const ReadyItem& ready, TileBand rows) {
    const TileRectangle& tiles = ready.item.area;
    const int first_column = std::max<int>(tiles.first_column, rays.first_column);
    const int end_column = std::min<int>(tiles.end_column, rays.first_column + rays.columns);
    const int end_row = std::min<int>(tiles.end_row, rows.end);
    for (int row = std::max<int>(tiles.first_row, rows.first); row < end_row; ++row) {
        const std::size_t at = rays.tile(first_column, row);
        const std::size_t end = rays.first[at + static_cast<std::size_t>(end_column - first_column)];
        for (std::size_t k = rays.first[at] * lanes; k < end * lanes; k += lanes) {
            cast_eight(ready, load(&rays.x[k]), load(&rays.y[k]),
                       {&rays.t[k], &rays.block[k], &rays.place[k]});
        }
    }
}

/// Of a band's rows, those within band `k` of the list.
TileBand within(TileBand band, int k) {
    return {std::max(band.first, k * rows_of_band), std::min(band.end, (k + 1) * rows_of_band)};
}

/// The list's items that may meet its band `k`, front to back.
std::span<const std::uint32_t> items_of(const BlockItems& items, int k) {
    const auto band = static_cast<std::size_t>(k);
    if (band + 1 >= items.first_of_band.size()) {
        return {};
    }
    const std::span<const std::uint32_t> all_of(items.banded);
    return all_of.subspan(items.first_of_band[band],
                          items.first_of_band[band + 1] - items.first_of_band[band]);
}

FRUSTUMSCREEN_INLINE void cast_all(CastPicture& picture, const BlockRelief& relief, const CastView& view,
                                   const BlockItems& items, TileBand band) {
    for (int k = band.first / rows_of_band; k * rows_of_band < band.end; ++k) {
        const TileBand rows = within(band, k);
        for (const std::uint32_t place : items_of(items, k)) {
            const BlockItem& item = items.sorted[place];
            if (item.centres.first_row < rows.end && item.centres.end_row > rows.first) {
                cast_item(picture, ready(relief, view, items, item), rows);
            }
        }
    }
}

FRUSTUMSCREEN_INLINE void cast_all(CastRays& rays, const BlockRelief& relief, const CastView& view,
                                   const BlockItems& items) {
    for (int k = rays.band.first / rows_of_band; k * rows_of_band < rays.band.end; ++k) {
        const TileBand rows = within(rays.band, k);
        for (const std::uint32_t place : items_of(items, k)) {
            cast_item(rays, ready(relief, view, items, items.sorted[place]), rows);
        }
    }
}

#if defined(__x86_64__)
template <typename... Arguments> [[gnu::target("avx2")]] void cast_with_avx2(Arguments&... arguments) {
    cast_all(arguments...);
}
#endif

template <typename... Arguments> void cast_plainly(Arguments&... arguments) {
    cast_all(arguments...);
}

template <typename... Arguments> void cast_by(Instructions instructions, Arguments&... arguments) {
#if defined(__x86_64__)
    if (instructions == Instructions::Best && __builtin_cpu_supports("avx2")) {
        cast_with_avx2(arguments...);
        return;
    }
#endif
    cast_plainly(arguments...);
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
          TileBand band, Instructions instructions) {
    const int left = view.lit.x / tile_width;
    const int right = std::min((view.lit.x + view.lit.width + tile_width - 1) / tile_width, picture.columns);
    for (int row = band.first; row < band.end && left < right; ++row) {
        const std::size_t begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.columns);
        std::fill_n(&picture.t[(begin + static_cast<std::size_t>(left)) * lanes],
                    static_cast<std::size_t>(right - left) * lanes, std::numeric_limits<float>::infinity());
    }
    cast_by(instructions, picture, relief, view, items, band);
}

void CastRays::begin(TileBand rows, int first_tile_column, int tile_columns) {
    band = rows;
    first_column = first_tile_column;
    columns = tile_columns;
    first.clear();
    x.clear();
    y.clear();
}

void cast(CastRays& rays, const BlockRelief& relief, const CastView& view, const BlockItems& items,
          Instructions instructions) {
    rays.t.assign(rays.x.size(), std::numeric_limits<float>::infinity());
    rays.block.resize(rays.x.size());
    rays.place.resize(rays.x.size());
    cast_by(instructions, rays, relief, view, items);
}

namespace {

/// Two channels at once, in the lower bytes of two halves: the mean of `from` and `to` with weights 256 - share and share.
std::uint32_t blend(std::uint32_t from, std::uint32_t to, std::uint32_t share) {
    constexpr std::uint32_t half = 0x00800080U;
    return (from * (256 - share) + to * share + half) >> 8U & 0x00FF00FFU;
}

} // namespace

glm::u8vec4 colour_at(const BlockRelief& relief, std::uint32_t block, std::uint32_t place) {
    constexpr std::uint32_t unit = CastPicture::places_per_cell;
    constexpr std::uint32_t end = block_cells * unit - 1;
    const std::uint32_t u = std::min(place & 0xFFFFU, end);
    const std::uint32_t v = std::min(place >> 16U, end);
    const std::uint32_t share_u = u % unit / (unit / 256);
    const std::uint32_t share_v = v % unit / (unit / 256);
    const glm::u8vec4* const corner = &relief.colours[std::size_t{block} * block_corners * block_corners +
                                                      (v / unit) * block_corners + u / unit];
    const auto mean = [&](unsigned shift) {
        const auto channels = [&](int at) {
            return std::bit_cast<std::uint32_t>(corner[at]) >> shift & 0x00FF00FFU;
        };
        return blend(blend(channels(0), channels(1), share_u),
                     blend(channels(block_corners), channels(block_corners + 1), share_u), share_v);
    };
    return std::bit_cast<glm::u8vec4>(mean(0) | mean(8) << 8U);
}

} // namespace frustumscreen
