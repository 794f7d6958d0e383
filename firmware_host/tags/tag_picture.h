/// A tag of family 36h11 as printed.
///
/// Threads  pure; any. Allocates.
#pragma once

#include "firmware_host/tags/tag_detector.h"

#include <array>
#include <cstddef>

namespace frustumscreen::tags {

/// Modules per row: the black square of `black_modules`, with a white margin of one module.
inline constexpr std::size_t tag_modules = 10;
inline constexpr std::size_t black_modules = 8;

/// [row][column], row 0 at the top; true: white.
using TagModules = std::array<std::array<bool, tag_modules>, tag_modules>;
/// `id`: 0 to 586.
[[nodiscard]] TagModules tag_modules_of(int id);

} // namespace frustumscreen::tags
