/// The probe: a reserved code in the picture that changes with every picture presented, so that a watchdog
/// can tell a resting exhibit from a hung one.
///
/// Shape    a row of `probe_pixels` pixels from the picture's top left corner; pixel k is grey of sRGB code 1
///          where bit k of the code is 0, and of code 2 where it is 1: hardly visible on a table, and never
///          black, so that a picture without a probe has no code. The code counts presents modulo 256; a
///          watchdog that looks more rarely than every 255th picture may meet the same code by chance, so it
///          looks at two in a row, one second of rest apart.
/// Colour   linear light into an sRGB framebuffer; read as sRGB codes.
/// Place    where the artifact or a caption may light the corner, the picture comes first and has no code.
/// Threads  functions that take a framebuffer: the render thread; they allocate nothing. The rest is pure.
#pragma once

#include "app/image/image.h"
#include "app/scene/frame_plan.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen {

inline constexpr int probe_pixels = 8;
inline constexpr std::size_t probe_bytes = 4 * std::size_t{probe_pixels}; ///< of RGBA

/// Writes only into the picture's corner. Returns false and writes nothing if `lit` covers the corner.
bool write_probe(unsigned framebuffer, std::uint8_t code, const PixelRectangle& lit);

/// The code in a picture's corner; nothing if there is none.
[[nodiscard]] std::optional<std::uint8_t> read_probe(const Image8& picture);
/// The same from the corner's pixels alone, RGBA codes.
[[nodiscard]] std::optional<std::uint8_t> read_probe(std::span<const std::byte, probe_bytes> corner);
/// The same from a framebuffer, once everything in it is drawn. It waits for the GPU, so it is not for every
/// frame.
[[nodiscard]] std::optional<std::uint8_t> read_probe(unsigned framebuffer);

/// Makes the corner black again, as the picture had it. A picture without a code is left alone.
void erase_probe(Image8& picture);

} // namespace frustumscreen
