#include "assets_baked/bake/triangle_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace frustumscreen::bake {

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

void compact(TriangleMesh& mesh) {
    std::vector<glm::vec3> used(mesh.positions.size());
    const std::size_t count =
        meshopt_optimizeVertexFetch(used.data(), mesh.indices.data(), mesh.indices.size(),
                                    mesh.positions.data(), mesh.positions.size(), sizeof(glm::vec3));
    used.resize(count);
    mesh.positions = std::move(used);
}

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

Result<void> check_surface(const TriangleMesh& welded) {
    if (welded.indices.empty()) {
        return bad_input("bake.degenerate", "every triangle is degenerate; there is no surface to show");
    }
    return {};
}

std::vector<glm::vec3> smooth_normals(const TriangleMesh& mesh) {
    std::vector<glm::vec3> normals(mesh.positions.size(), glm::vec3(0.0F));
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const glm::vec3 n = mesh.area_normal(t);
        for (int k = 0; k < 3; ++k) {
            normals[mesh.indices[3 * t + static_cast<std::size_t>(k)]] += n;
        }
    }
    for (glm::vec3& n : normals) {
        const float length = glm::length(n);
        n = length > 0.0F ? n / length : glm::vec3(0.0F, 0.0F, 1.0F);
    }
    return normals;
}

std::vector<glm::vec3> corner_normals(const TriangleMesh& mesh) {
    std::vector<glm::vec3> flat(mesh.triangle_count());
    std::vector<std::uint32_t> first_around(mesh.positions.size() + 1, 0); // index into `around`
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        flat[t] = mesh.area_normal(t);
    }
    for (const std::uint32_t position : mesh.indices) {
        ++first_around[position + 1];
    }
    std::partial_sum(first_around.begin(), first_around.end(), first_around.begin());
    std::vector<std::uint32_t> around(mesh.indices.size()); // triangles
    std::vector<std::uint32_t> end(first_around.begin(), first_around.end() - 1);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        around[end[mesh.indices[i]]++] = static_cast<std::uint32_t>(i / 3);
    }
    const auto cosine = static_cast<float>(std::cos(hard_edge_deg * std::numbers::pi / 180.0));
    std::vector<glm::vec3> normals(mesh.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const glm::vec3& own = flat[i / 3];
        const std::uint32_t position = mesh.indices[i];
        glm::vec3 sum(0.0F);
        for (std::uint32_t k = first_around[position]; k < first_around[position + 1]; ++k) {
            const glm::vec3& other = flat[around[k]];
            if (glm::dot(own, other) >= cosine * glm::length(own) * glm::length(other)) {
                sum += other;
            }
        }
        const float length = glm::length(sum);
        normals[i] = length > 0.0F ? sum / length : glm::vec3(0.0F, 0.0F, 1.0F);
    }
    return normals;
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

} // namespace frustumscreen::bake
