/// Parts of a mesh that triangles connect.
///
/// Threads  pure; any.
#pragma once

#include "app/geometry/union_find.h"
#include "assets_baked/bake/source_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::bake {

/// For each of `count` places, a place that all of its part share. `places`: the place of each vertex, below `count`
/// where a triangle uses it.
[[nodiscard]] inline std::vector<std::uint32_t>
connected_parts(const SourceMesh& mesh, std::span<const std::uint32_t> places, std::size_t count) {
    geometry::UnionFind parts(count);
    for (const auto& [a, b, c] : mesh.triangles) {
        parts.join(places[a], places[b]);
        parts.join(places[a], places[c]);
    }
    return parts.roots();
}

} // namespace frustumscreen::bake
