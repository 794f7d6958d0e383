/// Eight numbers at once, by the compiler's vectors: whatever the processor has for them makes the same numbers.
///
/// Threads  values; any. Vectors are passed between inlined functions alone.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

namespace frustumscreen {

inline constexpr int lanes = 8;
using Floats = float __attribute__((vector_size(4 * lanes)));
using Ints = std::int32_t __attribute__((vector_size(4 * lanes)));

/// For what is inlined into one function for each instruction set.
#define FRUSTUMSCREEN_INLINE [[gnu::always_inline]] inline
/// The same of a lambda, after its parameters.
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
FRUSTUMSCREEN_INLINE bool any(Ints mask) {
    std::array<std::uint64_t, lanes / 2> words;
    std::memcpy(words.data(), &mask, sizeof mask);
    return (words[0] | words[1] | words[2] | words[3]) != 0;
}
/// Bit k for lane k.
FRUSTUMSCREEN_INLINE unsigned bits_of(Ints mask) {
    mask &= Ints{1, 2, 4, 8, 16, 32, 64, 128};
    std::array<std::uint64_t, lanes / 2> words;
    std::memcpy(words.data(), &mask, sizeof mask);
    const std::uint64_t both = words[0] | words[1] | words[2] | words[3];
    return static_cast<unsigned>(both | both >> 32U) & 255U;
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
FRUSTUMSCREEN_INLINE float least_of(Floats values) {
    float least = values[0];
    for (int lane = 1; lane < lanes; ++lane) {
        least = values[lane] < least ? values[lane] : least;
    }
    return least;
}
FRUSTUMSCREEN_INLINE float most_of(Floats values) {
    return -least_of(-values);
}

} // namespace frustumscreen
