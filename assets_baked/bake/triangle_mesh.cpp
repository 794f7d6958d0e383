#include "assets_baked/bake/triangle_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace frustumscreen {

namespace {

/// Drops triangles whose corners repeat, and all but the first of those with the same three corners.
void drop_repetitions(std::vector<std::uint32_t>& indices) {
    using Key = std::array<std::uint32_t, 4>; // sorted corners, position in the list
    std::vector<Key> keys;
    keys.reserve(indices.size() / 3);
    for (std::uint32_t t = 0; 3 * static_cast<std::size_t>(t) < indices.size(); ++t) {
        std::array<std::uint32_t, 3> c{indices[3 * std::size_t{t}], indices[3 * std::size_t{t} + 1],
                                       indices[3 * std::size_t{t} + 2]};
        if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {
            continue;
        }
        std::sort(c.begin(), c.end());
        keys.push_back({c[0], c[1], c[2], t});
    }
    std::sort(keys.begin(), keys.end());
    keys.erase(
        std::unique(keys.begin(), keys.end(),
                    [](const Key& a, const Key& b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }),
        keys.end());
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a[3] < b[3]; });
    std::vector<std::uint32_t> kept;
    kept.reserve(3 * keys.size());
    for (const Key& key : keys) {
        kept.insert(kept.end(), indices.begin() + 3 * std::ptrdiff_t{key[3]},
                    indices.begin() + 3 * std::ptrdiff_t{key[3]} + 3);
    }
    indices = std::move(kept);
}

/// Drops vertices that no triangle uses.
void compact(TriangleMesh& mesh) {
    std::vector<glm::vec3> used(mesh.positions.size());
    const std::size_t count =
        meshopt_optimizeVertexFetch(used.data(), mesh.indices.data(), mesh.indices.size(),
                                    mesh.positions.data(), mesh.positions.size(), sizeof(glm::vec3));
    used.resize(count);
    mesh.positions = std::move(used);
}

} // namespace

TriangleMesh weld(const SourceMesh& mesh, std::span<const glm::dvec3> box_points) {
    TriangleMesh result;
    std::vector<glm::vec3> positions;
    positions.reserve(box_points.size());
    for (const glm::dvec3& p : box_points) {
        positions.emplace_back(glm::vec3(p) + glm::vec3(0.0F)); // -0 becomes 0: the weld compares bits
    }
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        indices.insert(indices.end(), triangle.begin(), triangle.end());
    }
    std::vector<std::uint32_t> remap(positions.size());
    const std::size_t count = meshopt_generateVertexRemap(
        remap.data(), indices.data(), indices.size(), positions.data(), positions.size(), sizeof(glm::vec3));
    result.positions.resize(count);
    meshopt_remapVertexBuffer(result.positions.data(), positions.data(), positions.size(), sizeof(glm::vec3),
                              remap.data());
    result.indices.resize(indices.size());
    meshopt_remapIndexBuffer(result.indices.data(), indices.data(), indices.size(), remap.data());
    drop_repetitions(result.indices);
    compact(result);
    return result;
}

namespace {

std::vector<std::uint32_t> simplified(const std::vector<std::uint32_t>& indices,
                                      const std::vector<glm::vec3>& positions, float tolerance_box,
                                      unsigned options) {
    std::vector<std::uint32_t> result(indices.size());
    const float scale = meshopt_simplifyScale(&positions[0].x, positions.size(), sizeof(glm::vec3));
    result.resize(meshopt_simplify(result.data(), indices.data(), indices.size(), &positions[0].x,
                                   positions.size(), sizeof(glm::vec3), 0,
                                   tolerance_box / std::max(scale, 1e-20F), options, nullptr));
    return result;
}

/// Each triangle with the grid cell of its centre, in the order of the cells.
std::vector<std::pair<std::uint64_t, std::uint32_t>> by_cell(const TriangleMesh& mesh, float offset_box) {
    constexpr float cell_box = 0.15F;
    constexpr float low = -2.0F; // of every box
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    order.reserve(mesh.triangle_count());
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const glm::vec3 centre = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0F;
        const glm::u64vec3 cell(glm::max((centre - low + offset_box) / cell_box, glm::vec3(0.0F)));
        order.emplace_back(cell.x << 42U | cell.y << 21U | cell.z, t);
    }
    std::sort(order.begin(), order.end());
    return order;
}

/// Simplifies each cell in its own coordinates and keeps what the cells share.
TriangleMesh simplify_in_cells(const TriangleMesh& mesh, float tolerance_box, float offset_box) {
    constexpr std::uint32_t unknown = 0xFFFFFFFFU;
    const auto order = by_cell(mesh, offset_box);
    TriangleMesh result{mesh.positions, {}};
    result.indices.reserve(mesh.indices.size());
    std::vector<std::uint32_t> local_of(mesh.positions.size(), unknown);
    for (std::size_t begin = 0; begin < order.size();) {
        std::vector<std::uint32_t> vertices;
        std::vector<std::uint32_t> indices;
        std::vector<glm::vec3> positions;
        std::size_t end = begin;
        for (; end < order.size() && order[end].first == order[begin].first; ++end) {
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t vertex = mesh.indices[3 * std::size_t{order[end].second} + c];
                if (local_of[vertex] == unknown) {
                    local_of[vertex] = static_cast<std::uint32_t>(vertices.size());
                    vertices.push_back(vertex);
                    positions.push_back(mesh.positions[vertex] - mesh.positions[vertices[0]]);
                }
                indices.push_back(local_of[vertex]);
            }
        }
        for (const std::uint32_t local :
             simplified(indices, positions, tolerance_box, meshopt_SimplifyLockBorder)) {
            result.indices.push_back(vertices[local]);
        }
        for (const std::uint32_t vertex : vertices) {
            local_of[vertex] = unknown;
        }
        begin = end;
    }
    return result;
}

} // namespace

TriangleMesh simplify(const TriangleMesh& mesh, float tolerance_box) {
    constexpr std::size_t dense = 50'000; // below, cells would hold little but border triangles
    TriangleMesh result = mesh;
    std::size_t before = 0;
    do {
        before = result.triangle_count();
        if (mesh.triangle_count() >= dense) {
            for (const float offset_box :
                 {0.0F, 0.075F}) { // a border of one grid is inside a cell of the other
                result = simplify_in_cells(result, tolerance_box, offset_box);
            }
        } else if (before > 0) {
            result.indices = simplified(result.indices, result.positions, tolerance_box, 0);
            drop_repetitions(result.indices);
        }
    } while (20 * result.triangle_count() < 19 * before);
    if (!result.indices.empty() && mesh.triangle_count() >= dense) { // open borders, which cells never change
        result.indices = simplified(result.indices, result.positions, tolerance_box, 0);
    }
    drop_repetitions(result.indices);
    compact(result);
    return result;
}

SourceMesh as_source(const TriangleMesh& mesh) {
    SourceMesh source;
    source.positions.assign(mesh.positions.begin(), mesh.positions.end());
    source.triangles.reserve(mesh.triangle_count());
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        source.triangles.push_back({mesh.indices[3 * t], mesh.indices[3 * t + 1], mesh.indices[3 * t + 2]});
    }
    source.triangle_materials.assign(source.triangles.size(), 0);
    source.materials.resize(1);
    return source;
}

} // namespace frustumscreen
