/// The place of a relief level's vertex, which is a texel of the relief atlas.
///
/// Frame    box. Codes are those of PackVertex: 0..65535 over the box's extent on each axis, over the
///          texture.
/// Threads  pure; any. 64-bit, so that every machine reconstructs the same codes.
#pragma once

#include "app/pack/pack.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace frustumscreen::pack {

inline constexpr std::uint16_t empty_relief = 65535;
inline constexpr double full_relief = 65534.0;

/// Axes of a chart: in-plane u and v, and the direction's own; 0: X, 1: Y, 2: Z.
struct ReliefAxes {
    int u = 0, v = 1, along = 2;
};
[[nodiscard]] ReliefAxes axes_of(ReliefDirection direction);

/// The box's lowest corner: it is centred on the Z axis and stands on z = 0.
[[nodiscard]] inline glm::dvec3 box_low(const glm::dvec3& box_size) {
    return {-box_size.x / 2.0, -box_size.y / 2.0, 0.0};
}

/// Nearest code of the centre of texel `x` of `width`.
[[nodiscard]] std::uint16_t uv_code(int x, int width);

/// The vertex at texel (x, y) of the atlas, which lies in `chart` and is not empty.
[[nodiscard]] PackVertex relief_vertex(const ReliefAtlas& atlas, const ReliefChart& chart, int x, int y,
                                       const glm::dvec3& box_size);

} // namespace frustumscreen::pack
