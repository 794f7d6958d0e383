/// Numbers for the cells of a grid that hold something.
#pragma once

#include "assets_baked/bake/key_numbers.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace frustumscreen::bake {

using CellNumbers = KeyNumbers<2>;

/// The most cells along an axis of a grid whose cells have keys.
inline constexpr std::int64_t max_cells_along = std::int64_t{1} << 21U;
/// `cell` within 0..max_cells_along - 1 along each axis.
[[nodiscard]] inline CellNumbers::Key key_of(const glm::i64vec3& cell) {
    const glm::u64vec3 c(cell);
    const std::uint64_t bits = c.x << 42U | c.y << 21U | c.z;
    return {static_cast<std::uint32_t>(bits >> 32U), static_cast<std::uint32_t>(bits)};
}

} // namespace frustumscreen::bake
