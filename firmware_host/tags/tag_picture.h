/// A tag of the family 36h11 as it is printed.
///
/// Threads  pure; any. Allocates.
#pragma once

#include "firmware_host/tags/tag_detector.h"

#include <array>
#include <cstddef>

namespace frustumscreen {

/// Modules in a row, with the white ones around the black square, which is `black_modules` wide.
inline constexpr std::size_t tag_modules = 10;
inline constexpr std::size_t black_modules = 8;

/// [row][column], row 0 at the top; true: white.
using TagModules = std::array<std::array<bool, tag_modules>, tag_modules>;
/// `id`: 0 to 586.
[[nodiscard]] TagModules tag_modules_of(int id);

} // namespace frustumscreen
