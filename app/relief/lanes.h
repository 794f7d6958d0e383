/// Eight numbers at once, by the compiler's vectors, with equal results on every processor.
///
/// Threads  values; any. Vectors are passed between inlined functions only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace frustumscreen::relief {

inline constexpr int lanes = 8;
using Floats = float __attribute__((vector_size(4 * lanes)));
using Ints = std::int32_t __attribute__((vector_size(4 * lanes)));

inline constexpr Ints lane_numbers = {0, 1, 2, 3, 4, 5, 6, 7};

/// For functions that are inlined into one function for each instruction set.
#define FRUSTUMSCREEN_INLINE [[gnu::always_inline]] inline
/// As above for a lambda, after its parameters.
#define FRUSTUMSCREEN_INLINED __attribute__((always_inline))

FRUSTUMSCREEN_INLINE Floats all(float value) {
    return Floats{} + value;
}
FRUSTUMSCREEN_INLINE Floats least(Floats a, Floats b) {
    return a < b ? a : b;
}
FRUSTUMSCREEN_INLINE Floats most(Floats a, Floats b) {
    return a > b ? a : b;
}
/// Bit k for lane k of a mask.
FRUSTUMSCREEN_INLINE unsigned bits_of(Ints mask) {
#if defined(__x86_64__) // one instruction that every x86-64 processor has; the compiler makes a dozen
    std::array<float __attribute__((vector_size(16))), 2> halves;
    std::memcpy(halves.data(), &mask, sizeof mask);
    return static_cast<unsigned>(__builtin_ia32_movmskps(halves[0]) | __builtin_ia32_movmskps(halves[1])
                                                                          << 4);
#else
    mask &= Ints{1, 2, 4, 8, 16, 32, 64, 128};
    std::array<std::uint64_t, lanes / 2> words;
    std::memcpy(words.data(), &mask, sizeof mask);
    const std::uint64_t both = words[0] | words[1] | words[2] | words[3];
    return static_cast<unsigned>(both | both >> 32U) & 255U;
#endif
}
FRUSTUMSCREEN_INLINE bool any(Ints mask) {
    return bits_of(mask) != 0;
}
/// For each mask of eight bits, the indices of its set bits, lowest first. The elements after them are
/// unspecified.
inline constexpr auto set_bits = [] {
    std::array<std::array<std::uint8_t, lanes>, 256> places{};
    for (unsigned mask = 0; mask < places.size(); ++mask) {
        std::size_t count = 0;
        for (unsigned bit = 0; bit < lanes; ++bit) {
            if ((mask >> bit & 1U) != 0) {
                places[mask][count++] = static_cast<std::uint8_t>(bit);
            }
        }
    }
    return places;
}();
FRUSTUMSCREEN_INLINE Floats load(const float* from) {
    Floats value;
    std::memcpy(&value, from, sizeof value);
    return value;
}
template <typename Vector, typename Word> FRUSTUMSCREEN_INLINE void store(Word* to, Vector value) {
    static_assert(sizeof(Vector) == lanes * sizeof(Word));
    std::memcpy(to, &value, sizeof value);
}
FRUSTUMSCREEN_INLINE float min_of(Floats values) {
    float least = values[0];
    for (int lane = 1; lane < lanes; ++lane) {
        least = values[lane] < least ? values[lane] : least;
    }
    return least;
}
FRUSTUMSCREEN_INLINE float max_of(Floats values) {
    return -min_of(-values);
}
FRUSTUMSCREEN_INLINE std::int32_t max_of(Ints values) {
    const auto larger = [](Ints a, Ints b) FRUSTUMSCREEN_INLINED { return a > b ? a : b; };
    values = larger(values, __builtin_shufflevector(values, values, 4, 5, 6, 7, 0, 1, 2, 3));
    values = larger(values, __builtin_shufflevector(values, values, 2, 3, 0, 1, 6, 7, 4, 5));
    return std::max(values[0], values[1]);
}

} // namespace frustumscreen::relief
