#include "app/relief/resolve_row.h"

#include "app/relief/lanes.h"

#include <algorithm>
#include <array>
#include <bit>

namespace frustumscreen::relief {

namespace {

constexpr std::int32_t unit = RasterSamples::places_per_cell;
using Words = std::uint32_t __attribute__((vector_size(4 * lanes)));

/// Two channels at once, in the lower bytes of two halves: the mean of `from` and `to` with weights 256 -
/// share and share.
FRUSTUMSCREEN_INLINE Words blend(Words from, Words to, Words share) {
    return (from * (256 - share) + to * share + 0x00800080U) >> 8 & 0x00FF00FFU;
}

/// Eight positions in blocks, one for each pixel or sample.
struct Shown {
    Ints block, place;
};

constexpr std::int32_t corners_of_block = block_corners * block_corners;

/// The corners' colours of a single relief, whose blocks have their own numbers.
class OneRelief {
public:
    explicit OneRelief(const BlockRelief& relief) : colours_(relief.colours.data()) {}
    [[nodiscard]] FRUSTUMSCREEN_INLINE Ints corners_of(Ints block) const { return block * corners_of_block; }
    [[nodiscard]] FRUSTUMSCREEN_INLINE const glm::u8vec4* colours(int /*lane*/, Ints /*block*/) const {
        return colours_;
    }
    [[nodiscard]] FRUSTUMSCREEN_INLINE Words lit(Words codes, Ints /*block*/) const { return codes; }

private:
    const glm::u8vec4* colours_;
};

/// The corners' colours of several reliefs, each in its light.
class SeveralReliefs {
public:
    explicit SeveralReliefs(const BlockPages& reliefs)
        : pages_(reliefs.pages().data()), lights_(reliefs.lights().data()),
          changes_light_(reliefs.changes_light()) {}
    [[nodiscard]] FRUSTUMSCREEN_INLINE Ints corners_of(Ints block) const {
        return (block & (of_page - 1)) * corners_of_block;
    }
    [[nodiscard]] FRUSTUMSCREEN_INLINE const glm::u8vec4* colours(int lane, Ints block) const {
        return page(lane, block).colours;
    }
    [[nodiscard]] FRUSTUMSCREEN_INLINE Words lit(Words codes, Ints block) const {
        return changes_light_ ? multiplied(codes, block) : codes;
    }

private:
    static constexpr auto of_page = static_cast<std::int32_t>(BlockPages::blocks_of_page);
    [[nodiscard]] FRUSTUMSCREEN_INLINE const BlockPages::Page& page(int lane, Ints block) const {
        return pages_[static_cast<std::uint32_t>(block[lane]) / BlockPages::blocks_of_page];
    }
    /// By the larger of sRGB's straight piece and its power law, since the factors are at most 1.
    [[nodiscard]] FRUSTUMSCREEN_INLINE Words multiplied(Words codes, Ints block) const {
        constexpr float offset = 0.055F * 255.0F;
        Words lit = codes & 0xFF000000U;
        for (int channel = 0; channel < 3; ++channel) {
            Floats linear, power;
            for (int lane = 0; lane < lanes; ++lane) {
                const BlockLight& light = lights_[page(lane, block).relief];
                linear[lane] = light.linear[channel];
                power[lane] = light.code[channel];
            }
            const auto shift = static_cast<unsigned>(8 * channel);
            const Floats code = __builtin_convertvector(std::bit_cast<Ints>(codes >> shift & 255U), Floats);
            const Floats shown = relief::most(linear * code, (code + offset) * power - offset);
            lit |= std::bit_cast<Words>(__builtin_convertvector(shown + 0.5F, Ints)) << shift;
        }
        return lit;
    }

    const BlockPages::Page* pages_;
    const BlockLight* lights_;
    bool changes_light_;
};

/// As colour_at, for eight positions.
template <typename Reliefs>
FRUSTUMSCREEN_INLINE Words colours_at(const Reliefs& reliefs, const Shown& shown) {
    const Ints u = shown.place & 0xFFFF;
    const Ints v = shown.place >> 16;
    const Ints corners = reliefs.corners_of(shown.block) + v / unit * block_corners + u / unit;
    // A corner and its right neighbour are one word of 64 bits.
    using Pairs = std::uint64_t __attribute__((vector_size(4 * lanes)));
    struct Row {
        Words left, right;
    };
    const auto row = [&](int down) FRUSTUMSCREEN_INLINED {
        const auto pair = [&](int lane) FRUSTUMSCREEN_INLINED {
            std::uint64_t two;
            std::memcpy(&two, reliefs.colours(lane, shown.block) + corners[lane] + down, sizeof two);
            return two;
        };
        const auto low = std::bit_cast<Words>(Pairs{pair(0), pair(1), pair(2), pair(3)});
        const auto high = std::bit_cast<Words>(Pairs{pair(4), pair(5), pair(6), pair(7)});
        return Row{__builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14),
                   __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15)};
    };
    const Row near = row(0);
    const Row far = row(block_corners);
    const auto share_u = std::bit_cast<Words>(u % unit / (unit / 256));
    const auto share_v = std::bit_cast<Words>(v % unit / (unit / 256));
    const auto mean = [&](int shift) FRUSTUMSCREEN_INLINED {
        const auto channels = [&](Words of) FRUSTUMSCREEN_INLINED { return of >> shift & 0x00FF00FFU; };
        return blend(blend(channels(near.left), channels(near.right), share_u),
                     blend(channels(far.left), channels(far.right), share_u), share_v);
    };
    return reliefs.lit(mean(0) | mean(8) << 8, shown.block);
}

/// The hits of the samples of eight pixels. Within a cell the codes are nearly linear, so their mean is the
/// code at the mean position.
struct Met {
    Ints one;     ///< pixels with a single position in one block, `shown`
    Ints several; ///< pixels with several positions
    Shown shown;
};

template <std::size_t count>
FRUSTUMSCREEN_INLINE Met met_by(const RasterSamples& samples, int x, int y, Ints pixels) {
    const auto words = [](const std::uint32_t* from) FRUSTUMSCREEN_INLINED {
        Ints value;
        std::memcpy(&value, from, sizeof value);
        return value;
    };
    const auto larger = [](Ints a, Ints b) FRUSTUMSCREEN_INLINED { return a > b ? a : b; };
    const auto smaller = [](Ints a, Ints b) FRUSTUMSCREEN_INLINED { return a < b ? a : b; };
    const Ints block = words(&samples.block[samples.at(x, y)]);
    Ints together = Ints{} - 1;
    Ints any_met{};
    Ints sum_u{}, sum_v{}, high_u{}, high_v{}, low_u = Ints{} + 0xFFFF, low_v = low_u;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t at = samples.at(x, y, k);
        const Ints met = load(&samples.nearness[at]) > 0.0F;
        const Ints place = words(&samples.place[at]);
        const Ints u = place & 0xFFFF;
        const Ints v = place >> 16;
        any_met |= met;
        together &= met & (words(&samples.block[at]) == block);
        high_u = larger(high_u, u);
        high_v = larger(high_v, v);
        low_u = smaller(low_u, u);
        low_v = smaller(low_v, v);
        sum_u += u;
        sum_v += v;
    }
    const Ints one = pixels & together & (larger(high_u - low_u, high_v - low_v) < unit);
    constexpr auto of = static_cast<std::int32_t>(count);
    return {one, pixels & any_met & ~one, {one & block, one & (sum_u / of | sum_v / of << 16)}};
}

/// Pixels whose samples hit several positions; each becomes the mean light of its samples or of its hits. They are
/// collected, so that the colours of eight samples, of any pixels, are looked up at once.
template <std::size_t count> class Several {
public:
    FRUSTUMSCREEN_INLINE bool full() const { return pixels_ == max_pixels; }
    FRUSTUMSCREEN_INLINE void add(const RasterSamples& samples, int x, int y, glm::u8vec4& code) {
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t at = samples.at(x, y, k);
            block_[shown_] = samples.block[at];
            place_[shown_] = samples.place[at];
            shown_ += samples.nearness[at] > 0.0F ? 1U : 0U;
        }
        code_[pixels_] = &code;
        end_[pixels_++] = shown_;
    }
    /// Writes the codes of all added pixels.
    template <typename Reliefs>
    FRUSTUMSCREEN_INLINE void resolve(const Reliefs& reliefs, const SampleLight& light, Outline outline) {
        for (std::size_t k = 0; k < shown_; k += lanes) {
            Shown shown;
            std::memcpy(&shown.block, &block_[k], sizeof shown.block);
            std::memcpy(&shown.place, &place_[k], sizeof shown.place);
            const Ints there = lane_numbers < static_cast<std::int32_t>(shown_ - k);
            const Words codes = colours_at(reliefs, {there & shown.block, there & shown.place});
            std::memcpy(static_cast<void*>(&colour_[k]), &codes, sizeof codes);
        }
        if (outline == Outline::OverBlack) {
            for_each_sum(light, [&](std::size_t pixel, const glm::uvec3& sum, unsigned /*hits*/)
                                    FRUSTUMSCREEN_INLINED { *code_[pixel] = light.mean(sum, count); });
        } else {
            for_each_sum(light,
                         [&](std::size_t pixel, const glm::uvec3& sum, unsigned hits) FRUSTUMSCREEN_INLINED {
                             *code_[pixel] = light.mean(sum, hits);
                             code_[pixel]->a = static_cast<std::uint8_t>(255 * hits / count);
                         });
        }
        pixels_ = shown_ = 0;
    }

private:
    /// Calls write(pixel, the light of its hits, their number) for all added pixels.
    template <typename Write>
    FRUSTUMSCREEN_INLINE void for_each_sum(const SampleLight& light, const Write& write) {
        std::size_t first = 0;
        for (std::size_t pixel = 0; pixel < pixels_; ++pixel) {
            glm::uvec3 sum(0);
            const std::size_t begin = first;
            for (; first < end_[pixel]; ++first) {
                sum += light.light(colour_[first]);
            }
            write(pixel, sum, static_cast<unsigned>(first - begin));
        }
    }

    static constexpr std::size_t max_pixels = 64;
    static constexpr std::size_t max_shown =
        max_pixels * count + lanes; ///< eights are read and written whole
    std::size_t pixels_ = 0, shown_ = 0;
    std::array<std::uint32_t, max_shown> block_, place_; ///< of the samples with a hit
    std::array<glm::u8vec4, max_shown> colour_;
    std::array<glm::u8vec4*, max_pixels> code_;
    std::array<std::size_t, max_pixels> end_; ///< one past the pixel's last sample
};

template <std::size_t count, typename Reliefs>
FRUSTUMSCREEN_INLINE void resolve_samples(const RasterSamples& samples, const Reliefs& reliefs,
                                          const SampleLight& light, int y, int first,
                                          std::span<glm::u8vec4> codes, Outline outline) {
    Several<count> several;
    for (std::size_t begin = 0; begin < codes.size(); begin += lanes) {
        const std::size_t rest = std::min<std::size_t>(lanes, codes.size() - begin);
        const int x = first + static_cast<int>(begin);
        const Ints pixels = lane_numbers < static_cast<std::int32_t>(rest);
        const Met met = met_by<count>(samples, x, y, pixels);
        Words together{};
        if (any(met.one)) {
            together = std::bit_cast<Words>(met.one) & colours_at(reliefs, met.shown);
        }
        std::memcpy(static_cast<void*>(&codes[begin]), &together, rest * sizeof(glm::u8vec4));
        for (unsigned bits = bits_of(met.several); bits != 0; bits &= bits - 1) {
            const int lane = std::countr_zero(bits);
            if (several.full()) {
                several.resolve(reliefs, light, outline);
            }
            several.add(samples, x + lane, y, codes[begin + static_cast<std::size_t>(lane)]);
        }
    }
    several.resolve(reliefs, light, outline);
}

template <typename Reliefs>
FRUSTUMSCREEN_INLINE void resolve(const RasterSamples& samples, const Reliefs& reliefs,
                                  const SampleLight& light, int y, int first, std::span<glm::u8vec4> codes,
                                  Outline outline) {
    switch (samples.places().size()) {
    case 1:
        return resolve_samples<1>(samples, reliefs, light, y, first, codes, outline);
    case 2:
        return resolve_samples<2>(samples, reliefs, light, y, first, codes, outline);
    case 4:
        return resolve_samples<4>(samples, reliefs, light, y, first, codes, outline);
    case 8:
        return resolve_samples<8>(samples, reliefs, light, y, first, codes, outline);
    default:
        return resolve_samples<RasterSamples::most>(samples, reliefs, light, y, first, codes, outline);
    }
}

} // namespace

void resolve_row(const RasterSamples& samples, const BlockPages& reliefs, const SampleLight& light, int y,
                 int first, std::span<glm::u8vec4> codes, Outline outline, Instructions instructions) {
    if (reliefs.only() != nullptr) {
        const OneRelief one(*reliefs.only());
        run_with<resolve<OneRelief>>(instructions, samples, one, light, y, first, codes, outline);
    } else {
        const SeveralReliefs several(reliefs);
        run_with<resolve<SeveralReliefs>>(instructions, samples, several, light, y, first, codes, outline);
    }
}

} // namespace frustumscreen::relief
