#include "app/relief/rasterize_blocks.h"

#include "app/relief/item_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

namespace frustumscreen::relief {

namespace {

/// Fragments on their way into the picture. Taking each at once, lane by lane, would need a branch per
/// fragment that cannot be predicted. So they are stored in eights, `list_` names the valid ones, and one
/// loop takes them all.
class Fragments {
public:
    FRUSTUMSCREEN_INLINE bool full() const { return eights_ == max_eights; }
    FRUSTUMSCREEN_INLINE void add(const Fragment& fragment, Ints in, int row, Ints sample) {
        const unsigned bits = bits_of(fragment.met & in);
        const std::size_t at = eights_ * lanes;
        store(&u_[at], fragment.u);
        store(&v_[at], fragment.v);
        store(&nearness_[at], fragment.nearness);
        store(&sample_[at], sample);
        row_[eights_] = row;
        bits_[eights_] = static_cast<std::uint8_t>(bits);
        eights_ += bits != 0 ? 1U : 0U; // half of the eights have no valid lane: the next one overwrites them
    }
    /// Stores the fragments that are nearer than the samples' earlier hits.
    FRUSTUMSCREEN_INLINE void take(RasterSamples& samples, const ReadyItem& ready) {
        const std::size_t count = list();
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t from = list_[k];
            const auto to = static_cast<std::size_t>(sample_[from]);
            bool taken = nearness_[from] > samples.nearness[to];
            if (ready.block.cut != 0) {
                taken = taken && is_covered(ready, place_[from]);
            }
            if (taken) {
                samples.nearness[to] = nearness_[from];
                samples.block[to] = ready.number;
                samples.place[to] = place_[from];
            }
        }
        eights_ = 0;
    }

private:
    using Bytes = std::uint8_t __attribute__((vector_size(lanes)));
    using Halves = std::uint16_t __attribute__((vector_size(2 * lanes)));

    /// Computes the positions and lists the valid fragments; returns their number.
    FRUSTUMSCREEN_INLINE std::size_t list() {
        constexpr auto unit = static_cast<std::int32_t>(RasterSamples::places_per_cell);
        const auto part = [](Floats at) FRUSTUMSCREEN_INLINED {
            return __builtin_convertvector(
                least(most(at * static_cast<float>(unit), Floats{}), all(static_cast<float>(unit - 1))),
                Ints);
        };
        std::size_t count = 0;
        for (std::size_t k = 0; k < eights_; ++k) {
            const std::size_t at = k * lanes;
            const Ints u = part(load(&u_[at])) + lane_numbers * unit;
            const Ints v = part(load(&v_[at])) + row_[k] * unit;
            store(&place_[at], u | v << 16);
            Bytes counting;
            std::memcpy(&counting, set_bits[bits_[k]].data(), sizeof counting);
            store(&list_[count], __builtin_convertvector(counting, Halves) + static_cast<std::uint16_t>(at));
            count += static_cast<std::size_t>(std::popcount(bits_[k]));
        }
        return count;
    }

    static constexpr std::size_t max_eights = 64;
    static constexpr std::size_t capacity =
        (max_eights + 1) * lanes; ///< including an eight that is overwritten
    std::size_t eights_ = 0;
    std::array<float, capacity> u_, v_, nearness_;
    std::array<std::int32_t, capacity> sample_;
    std::array<std::uint32_t, capacity> place_;
    std::array<std::int32_t, max_eights + 1> row_;
    std::array<std::uint8_t, max_eights + 1> bits_; ///< which lanes are valid
    std::array<std::uint16_t, capacity> list_;      ///< eight elements are written, however many are valid
};

/// The pixels that the dither takes: Bayer's matrix of 8 x 8, as in the shaders.
FRUSTUMSCREEN_INLINE Ints taken_by(const Dither& dither, Ints x, Ints y) {
    const Ints q = x ^ y;
    const Ints rank = (q & 1) << 5 | (y & 1) << 4 | (q & 2) << 2 | (y & 2) << 1 | (q & 4) >> 1 | (y & 4) >> 2;
    const Ints within = (__builtin_convertvector(rank, Floats) + 0.5F) * (1.0F / 64.0F) < dither.share;
    return dither.complement ? ~within : within;
}

FRUSTUMSCREEN_INLINE Ints in_face(const ReadyItem& ready, const PixelLanes& pixels) {
    const PixelLanes at = ready.lens.bends ? unbent(ready.lens, pixels) : pixels;
    Ints inside = Ints{} - 1;
    for (const glm::vec3& edge : ready.edges) {
        inside &= edge.x * at.x + edge.y * at.y + edge.z > 0.0F;
    }
    for (const glm::vec3 edge : ready.more_edges) {
        inside &= edge.x * at.x + edge.y * at.y + edge.z > 0.0F;
    }
    return inside;
}

/// Rasterizes eight cells of a row into the samples of the pixels within `limits`.
template <bool dithers>
FRUSTUMSCREEN_INLINE void rasterize_cells(RasterSamples& samples, Fragments& fragments,
                                          const ReadyItem& ready, const CellCorners& corners, Ints cells,
                                          int row, const PixelSpan& limits) {
    const CellRow at = cell_row(corners, cells, ready.outward);
    const auto count = static_cast<int>(samples.places().size());
    const PixelRectangle& all_pixels = samples.pixels();
    CellSteps steps{};
    bool ready_to_step = false; // many rows have no sample in any cell
    for (int k = 0; k < count; ++k) {
        const glm::vec2& sample = samples.places()[static_cast<std::size_t>(k)];
        const CellPixels pixels = cell_pixels(at, limits, sample);
        if (!any(pixels.there)) {
            continue;
        }
        steps = ready_to_step ? steps : cell_steps(corners);
        ready_to_step = true;
        const Ints first =
            ((pixels.top - all_pixels.y) * count + k) * all_pixels.width + (pixels.left - all_pixels.x);
        const auto visit = [&](const Weights& weights, Ints in, Ints x, int y) FRUSTUMSCREEN_INLINED {
            if (!ready.item.inside) {
                in &= in_face(ready, {__builtin_convertvector(pixels.left + x, Floats) + sample.x,
                                      __builtin_convertvector(pixels.top + y, Floats) + sample.y});
            }
            if constexpr (dithers) {
                in &= taken_by(*ready.dither, pixels.left + x, pixels.top + y);
            }
            fragments.add(fragment_at(at, corners, weights), in, row,
                          first + (y * count * all_pixels.width + x));
            if (fragments.full()) {
                fragments.take(samples, ready);
            }
        };
        for_each_pixel(pixels, at, corners, steps, sample, visit);
    }
}

/// True if all of the area's samples already have a nearer hit.
FRUSTUMSCREEN_INLINE bool is_hidden(const RasterSamples& samples, const PixelSpan& area, float nearest) {
    for (int y = area.top; y < area.bottom; ++y) {
        for (std::size_t k = 0; k < samples.places().size(); ++k) {
            const float* const row = &samples.nearness[samples.at(area.left, y, k)];
            for (int x = 0; x < area.right - area.left; x += lanes) {
                if (any((load(row + x) < nearest) & (lane_numbers + x < area.right - area.left))) {
                    return false;
                }
            }
        }
    }
    return true;
}

template <bool dithers>
FRUSTUMSCREEN_INLINE void rasterize_item(RasterSamples& samples, const ReadyItem& ready,
                                         const PixelSpan& limits, Fragments& fragments) {
    if (limits.left >= limits.right || is_hidden(samples, limits, ready.item.nearest)) {
        return;
    }
    for (int y = limits.top; y < limits.bottom; ++y) {
        samples.widen(y, {limits.left, limits.right});
    }
    const auto meet = [&](const CellCorners& corners, Ints cells, int row) FRUSTUMSCREEN_INLINED {
        rasterize_cells<dithers>(samples, fragments, ready, corners, cells, row, limits);
    };
    for_each_row(ready, meet);
    fragments.take(samples, ready);
}

template <bool dithers>
FRUSTUMSCREEN_INLINE void rasterize_all(RasterSamples& samples, const BlockRelief& relief,
                                        const RasterView& view, const BlockItems& items,
                                        const RasterShare& share) {
    Fragments fragments;
    const PixelRectangle& pixels = samples.pixels();
    for (int k = pixels.y / rows_of_band; k * rows_of_band < pixels.y + pixels.height; ++k) {
        for (const std::uint32_t place : items_of(items, k)) {
            const BlockItem& item = items.sorted[place];
            rasterize_item<dithers>(samples, ready(relief, view, items, item, share),
                                    within(item.area, pixels, k), fragments);
        }
    }
}

/// Sample k of n: column k and a row of its own in a grid of n x n, rows in the order of reversed bits
/// (Hammersley 1960), so that an edge of any slope crosses the samples one at a time.
glm::vec2 sample_place(int k, int n) {
    int reversed = 0;
    for (int bit = 1, of = n / 2; bit < n; bit *= 2, of /= 2) {
        reversed += (k & bit) != 0 ? of : 0;
    }
    return (glm::vec2(k, reversed) + 0.5F) / static_cast<float>(n);
}

} // namespace

void RasterSamples::make_space(int width, int height, int count) {
    const std::size_t samples =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(count) +
        lanes;
    places_.reserve(static_cast<std::size_t>(count));
    extents_.reserve(static_cast<std::size_t>(height));
    nearness.reserve(samples);
    block.resize(std::max(block.size(), samples));
    place.resize(std::max(place.size(), samples));
}

void RasterSamples::begin(const PixelRectangle& pixels, int count) {
    make_space(pixels.width, pixels.height, count);
    pixels_ = pixels;
    places_.clear();
    for (int k = 0; k < count; ++k) {
        places_.push_back(sample_place(k, count));
    }
    extents_.assign(static_cast<std::size_t>(pixels.height), {pixels.x + pixels.width, pixels.x});
    nearness.assign(static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height) *
                            static_cast<std::size_t>(count) +
                        lanes,
                    0.0F);
}

void rasterize(RasterSamples& samples, const BlockRelief& relief, const RasterView& view,
               const BlockItems& items, const RasterShare& share, Instructions instructions) {
    if (share.dither) {
        run_with<rasterize_all<true>>(instructions, samples, relief, view, items, share);
    } else {
        run_with<rasterize_all<false>>(instructions, samples, relief, view, items, share);
    }
}

namespace {

/// Two channels at once, in the lower bytes of two halves: the mean of `from` and `to` with weights 256 -
/// share and share.
std::uint32_t blend(std::uint32_t from, std::uint32_t to, std::uint32_t share) {
    constexpr std::uint32_t half = 0x00800080U;
    return (from * (256 - share) + to * share + half) >> 8U & 0x00FF00FFU;
}

} // namespace

glm::u8vec4 colour_at(const BlockRelief& relief, std::uint32_t block, std::uint32_t place) {
    constexpr std::uint32_t unit = RasterSamples::places_per_cell;
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

} // namespace frustumscreen::relief
