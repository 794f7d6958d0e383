/// The code in a picture's corner that changes with every presented picture, so that a watchdog can tell a
/// still picture from a hung one. This header needs neither OpenGL nor a picture type; app/render/probe.h
/// draws the code.
///
/// Shape    a row of `probe_pixels` pixels from the picture's top left corner. Pixel k is grey of sRGB code 1
///          if bit k of the code is 0, and of code 2 if it is 1: hardly visible on a table, but never black,
///          so a picture without a probe has no code. The code counts presents modulo 256. A watchdog that
///          samples less often than every 255th picture may see an equal code by chance, so it compares two
///          samples one second apart.
/// Threads  pure; any.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen {

inline constexpr int probe_pixels = 8;
inline constexpr std::size_t probe_bytes = 4 * std::size_t{probe_pixels}; ///< RGBA
/// sRGB codes of a 0 and a 1 in the exhibit's picture and in the safe picture; the difference tells the
/// watchdog which one is on the screen.
inline constexpr std::array<std::uint8_t, 2> probe_greys{1, 2};
inline constexpr std::array<std::uint8_t, 2> safe_probe_greys{3, 4};

/// Bit `pixel` of the code.
[[nodiscard]] constexpr bool probe_bit(std::uint8_t code, int pixel) {
    return ((code >> static_cast<unsigned>(pixel)) & 1U) != 0;
}
/// The grey of the corner's `pixel`.
[[nodiscard]] constexpr std::uint8_t probe_grey(std::uint8_t code, int pixel,
                                                const std::array<std::uint8_t, 2>& greys = probe_greys) {
    return greys[probe_bit(code, pixel) ? 1 : 0];
}

/// The code in the corner's pixels, given as RGBA codes; nullopt if they hold no code. Alpha is ignored.
[[nodiscard]] constexpr std::optional<std::uint8_t>
read_probe(std::span<const std::byte, probe_bytes> corner) {
    unsigned code = 0;
    for (std::size_t k = 0; k < std::size_t{probe_pixels}; ++k) {
        const auto red = std::to_integer<std::uint8_t>(corner[4 * k]);
        const bool grey = corner[4 * k + 1] == corner[4 * k] && corner[4 * k + 2] == corner[4 * k];
        if (!grey || (red != probe_greys[0] && red != probe_greys[1])) {
            return std::nullopt;
        }
        code |= (red == probe_greys[1] ? 1U : 0U) << k;
    }
    return static_cast<std::uint8_t>(code);
}

} // namespace frustumscreen
