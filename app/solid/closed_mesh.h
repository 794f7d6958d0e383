/// A surface that closes up around one body: each edge belongs to two polygons, which run along it in
/// opposite directions.
///
/// Frame    that of the polygons. Metres.
/// Errors   one sentence that names an edge or a place.
/// Threads  pure; any.
#pragma once

#include "app/solid/polygon_mesh.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <vector>

namespace frustumscreen::solid {

/// An edge and the polygons on both sides of it.
struct SharedEdge {
    std::uint32_t from = 0, to = 0;    ///< vertices
    std::uint32_t left = 0, right = 0; ///< polygons: `left` runs along the edge from `from` to `to`
};

/// Only `close_up` makes one.
struct ClosedMesh {
    PolygonMesh mesh; ///< vertices at one place are one; a polygon has three different corners or more
    std::vector<SharedEdge> edges;
    double size_m = 0.0;    ///< longest edge of the box around it
    double volume_m3 = 0.0; ///< positive: turned if all polygons were inside out
    bool was_inside_out = false;
};

/// A prop's size: the longest edge of the box around it.
inline constexpr double min_size_m = 0.01;
inline constexpr double max_size_m = 2.0;

/// Vertices closer than this share of the size are one: 1.2 micrometres for a prop of 12 cm. 32-bit numbers
/// round to a hundredth of it.
inline constexpr double weld_share = 1e-5;

[[nodiscard]] Result<ClosedMesh> close_up(PolygonMesh mesh);

} // namespace frustumscreen::solid
