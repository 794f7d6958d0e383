/// A convex polygon as quadrilaterals around its first corner, to be drawn by what draws quadrilaterals.
///
/// Neighbouring quadrilaterals share an edge; behind a lens both bend it at the same places. A polygon with an odd
/// number of corners has its last corner twice.
///
/// Threads  pure; any.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace frustumscreen::geometry {

/// The number of quadrilaterals of a polygon with `corners` corners, three or more.
[[nodiscard]] constexpr std::size_t fan_quads(std::size_t corners) {
    return (corners - 1) / 2;
}

/// The corners of quadrilateral `k`, in the polygon's order. A polygon of four is its own only quadrilateral.
[[nodiscard]] constexpr std::array<std::size_t, 4> fan_quad(std::size_t corners, std::size_t k) {
    return {0, 2 * k + 1, 2 * k + 2, std::min(2 * k + 3, corners - 1)};
}

} // namespace frustumscreen::geometry
