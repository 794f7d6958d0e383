/// Parts of a mesh that triangles connect: union-find with path halving.
///
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace frustumscreen::bake {

/// For each of `count` places, a place that all of its part share. `places`: the place of each vertex, below `count`
/// where a triangle uses it.
[[nodiscard]] inline std::vector<std::uint32_t>
connected_parts(const SourceMesh& mesh, std::span<const std::uint32_t> places, std::size_t count) {
    std::vector<std::uint32_t> parent(count);
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v) {
            parent[v] = parent[parent[v]];
            v = parent[v];
        }
        return v;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::uint32_t first = root(places[a]);
        parent[root(places[b])] = first;
        parent[root(places[c])] = first;
    }
    for (std::uint32_t& each : parent) {
        each = root(each);
    }
    return parent;
}

} // namespace frustumscreen::bake
