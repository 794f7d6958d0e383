#include "app/relief/resolve_row.h"

#include "app/relief/lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace frustumscreen {

namespace {

constexpr std::uint32_t unit = CastSamples::places_per_cell;
using Words = std::uint32_t __attribute__((vector_size(4 * lanes)));

/// A pixel whose samples are shown by one place of one block.
struct Shown {
    std::uint32_t block = 0, place = 0;
};
enum class Met { Nothing, OnePlace, Several };

/// What the samples of a pixel met, from `first` on; `shown` is told of one place alone. Within a cell the codes are nearly even: their
/// mean is the one in the middle.
template <std::size_t count>
FRUSTUMSCREEN_INLINE Met met_by(const CastSamples& samples, std::size_t first, Shown& shown) {
    const std::uint32_t block = samples.block[first];
    std::uint32_t low_u = std::numeric_limits<std::uint32_t>::max(), low_v = low_u;
    std::uint32_t high_u = 0, high_v = 0, sum_u = 0, sum_v = 0;
    std::size_t met = 0;
    bool together = true;
    for (std::size_t k = first; k < first + count; ++k) {
        const bool here = samples.nearness[k] > 0.0F;
        const std::uint32_t u = samples.place[k] & 0xFFFFU;
        const std::uint32_t v = samples.place[k] >> 16U;
        met += here ? 1 : 0;
        together = together && here && samples.block[k] == block;
        low_u = std::min(low_u, u);
        low_v = std::min(low_v, v);
        high_u = std::max(high_u, u);
        high_v = std::max(high_v, v);
        sum_u += u;
        sum_v += v;
    }
    if (met == 0) {
        return Met::Nothing;
    }
    if (!together || std::max(high_u - low_u, high_v - low_v) >= unit) {
        return Met::Several;
    }
    constexpr auto of = static_cast<std::uint32_t>(count);
    shown = {block, sum_u / of | sum_v / of << 16U};
    return Met::OnePlace;
}

/// Two channels at once, in the lower bytes of two halves: the mean of `from` and `to` with weights 256 - share and share.
FRUSTUMSCREEN_INLINE Words blend(Words from, Words to, Words share) {
    return (from * (256 - share) + to * share + 0x00800080U) >> 8 & 0x00FF00FFU;
}

/// As colour_at, of eight places.
FRUSTUMSCREEN_INLINE void colours_at(const BlockRelief& relief, const std::array<Shown, lanes>& shown,
                                     std::uint32_t* codes) {
    std::array<std::array<std::uint32_t, lanes>, 6> at{}; // four corners, two shares
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto& [block, place] = shown[lane];
        const std::uint32_t u = place & 0xFFFFU;
        const std::uint32_t v = place >> 16U;
        const glm::u8vec4* const corner = &relief.colours[std::size_t{block} * block_corners * block_corners +
                                                          (v / unit) * block_corners + u / unit];
        at[0][lane] = std::bit_cast<std::uint32_t>(corner[0]);
        at[1][lane] = std::bit_cast<std::uint32_t>(corner[1]);
        at[2][lane] = std::bit_cast<std::uint32_t>(corner[block_corners]);
        at[3][lane] = std::bit_cast<std::uint32_t>(corner[block_corners + 1]);
        at[4][lane] = u % unit / (unit / 256);
        at[5][lane] = v % unit / (unit / 256);
    }
    const auto words = [&](std::size_t k) FRUSTUMSCREEN_INLINED {
        Words value;
        std::memcpy(&value, at[k].data(), sizeof value);
        return value;
    };
    const Words share_u = words(4);
    const Words share_v = words(5);
    const auto mean = [&](int shift) FRUSTUMSCREEN_INLINED {
        const auto channels = [&](std::size_t corner)
                                  FRUSTUMSCREEN_INLINED { return words(corner) >> shift & 0x00FF00FFU; };
        return blend(blend(channels(0), channels(1), share_u), blend(channels(2), channels(3), share_u),
                     share_v);
    };
    store(codes, mean(0) | mean(8) << 8);
}

/// The mean light of samples that do not show one place.
glm::u8vec4 mean_code(const CastSamples& samples, std::size_t first, std::size_t count,
                      const BlockRelief& relief, const SampleLight& light) {
    glm::uvec3 sum(0);
    for (std::size_t k = first; k < first + count; ++k) {
        if (samples.nearness[k] > 0.0F) {
            sum += light.light(colour_at(relief, samples.block[k], samples.place[k]));
        }
    }
    return light.mean(sum, static_cast<unsigned>(count));
}

template <std::size_t count>
FRUSTUMSCREEN_INLINE void resolve_samples(const CastSamples& samples, const BlockRelief& relief,
                                          const SampleLight& light, int y, int first,
                                          std::span<glm::u8vec4> codes) {
    for (std::size_t begin = 0; begin < codes.size(); begin += lanes) {
        const std::size_t pixels = std::min<std::size_t>(lanes, codes.size() - begin);
        const std::size_t from = samples.at(first + static_cast<int>(begin), y);
        std::array<Shown, lanes> shown{};
        std::array<Met, lanes> met{};
        bool any_place = false;
        for (std::size_t k = 0; k < pixels; ++k) {
            met[k] = met_by<count>(samples, from + k * count, shown[k]);
            any_place = any_place || met[k] == Met::OnePlace;
        }
        std::array<std::uint32_t, lanes> together{};
        if (any_place) {
            colours_at(relief, shown, together.data());
        }
        for (std::size_t k = 0; k < pixels; ++k) {
            codes[begin + k] = met[k] == Met::OnePlace ? std::bit_cast<glm::u8vec4>(together[k])
                               : met[k] == Met::Several
                                   ? mean_code(samples, from + k * count, count, relief, light)
                                   : glm::u8vec4(0);
        }
    }
}

FRUSTUMSCREEN_INLINE void resolve(const CastSamples& samples, const BlockRelief& relief,
                                  const SampleLight& light, int y, int first, std::span<glm::u8vec4> codes) {
    switch (samples.places().size()) {
    case 1:
        return resolve_samples<1>(samples, relief, light, y, first, codes);
    case 2:
        return resolve_samples<2>(samples, relief, light, y, first, codes);
    case 4:
        return resolve_samples<4>(samples, relief, light, y, first, codes);
    case 8:
        return resolve_samples<8>(samples, relief, light, y, first, codes);
    default:
        return resolve_samples<CastSamples::most>(samples, relief, light, y, first, codes);
    }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void resolve_with_avx2(const CastSamples& samples, const BlockRelief& relief,
                                               const SampleLight& light, int y, int first,
                                               std::span<glm::u8vec4> codes) {
    resolve(samples, relief, light, y, first, codes);
}
#endif

void resolve_plainly(const CastSamples& samples, const BlockRelief& relief, const SampleLight& light, int y,
                     int first, std::span<glm::u8vec4> codes) {
    resolve(samples, relief, light, y, first, codes);
}

} // namespace

void resolve_row(const CastSamples& samples, const BlockRelief& relief, const SampleLight& light, int y,
                 int first, std::span<glm::u8vec4> codes, Instructions instructions) {
#if defined(__x86_64__)
    if (instructions == Instructions::Best && __builtin_cpu_supports("avx2")) {
        resolve_with_avx2(samples, relief, light, y, first, codes);
        return;
    }
#endif
    resolve_plainly(samples, relief, light, y, first, codes);
}

} // namespace frustumscreen
