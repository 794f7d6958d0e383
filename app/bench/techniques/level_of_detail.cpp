#include "app/bench/techniques/level_of_detail.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <limits>

namespace frustumscreen::bench {

namespace {

/// Every attribute that must be equal for two corners to share a vertex; compared as bytes.
struct Vertex {
    glm::vec3 position; ///< from the box's corner, where 32-bit numbers are finest
    glm::vec2 uv;
    glm::vec4 colour;
    std::uint32_t material;
};
static_assert(sizeof(Vertex) == 10 * sizeof(float));

struct Indexed {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> original; ///< per vertex: one vertex of the source
    std::vector<std::uint32_t> indices;
};

Indexed joined(const bake::SourceMesh& mesh) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    for (const glm::dvec3& position : mesh.positions) {
        low = glm::min(low, position);
    }
    std::vector<Vertex> corners;
    corners.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t k : mesh.triangles[t]) { // + 0 turns -0 into 0
            corners.push_back({.position = glm::vec3(mesh.positions[k] - low) + 0.0F,
                               .uv = mesh.uvs.empty() ? glm::vec2(0.0F) : mesh.uvs[k] + 0.0F,
                               .colour = mesh.colours.empty() ? glm::vec4(1.0F) : mesh.colours[k] + 0.0F,
                               .material = mesh.triangle_materials[t]});
        }
    }
    Indexed result;
    result.indices.resize(corners.size());
    result.vertices.resize(meshopt_generateVertexRemap(result.indices.data(), nullptr, corners.size(),
                                                       corners.data(), corners.size(), sizeof(Vertex)));
    result.original.resize(result.vertices.size());
    for (std::size_t k = 0; k < corners.size(); ++k) { // for unindexed corners the remap is the index buffer
        result.vertices[result.indices[k]] = corners[k];
        result.original[result.indices[k]] = mesh.triangles[k / 3][k % 3];
    }
    return result;
}

/// The source's mesh reduced to these triangles, vertices in the order of their use.
bake::SourceMesh with_triangles(const bake::SourceMesh& mesh, const Indexed& indexed,
                                const std::vector<std::uint32_t>& indices) {
    constexpr std::uint32_t unused = 0xFFFFFFFFU;
    bake::SourceMesh result;
    result.materials = mesh.materials;
    result.textures = mesh.textures;
    result.default_up = mesh.default_up;
    std::vector<std::uint32_t> place(indexed.vertices.size(), unused);
    for (std::size_t k = 0; k < indices.size(); ++k) {
        const std::uint32_t vertex = indices[k];
        if (place[vertex] == unused) {
            const std::uint32_t original = indexed.original[vertex];
            place[vertex] = static_cast<std::uint32_t>(result.positions.size());
            result.positions.push_back(mesh.positions[original]);
            if (!mesh.uvs.empty()) {
                result.uvs.push_back(mesh.uvs[original]);
            }
            if (!mesh.colours.empty()) {
                result.colours.push_back(mesh.colours[original]);
            }
        }
        if (k % 3 == 0) {
            result.triangles.emplace_back();
            result.triangle_materials.push_back(indexed.vertices[vertex].material);
        }
        result.triangles.back()[k % 3] = place[vertex];
    }
    return result;
}

LevelOfDetail simplified(const bake::SourceMesh& mesh, const Indexed& indexed, std::size_t target) {
    const float* positions = &indexed.vertices[0].position.x;
    std::vector<std::uint32_t> indices(indexed.indices.size());
    float error = 0.0F;
    constexpr float any_error = 1.0F; // relative to the mesh's extent: the count alone decides
    indices.resize(meshopt_simplify(indices.data(), indexed.indices.data(), indexed.indices.size(), positions,
                                    indexed.vertices.size(), sizeof(Vertex), 3 * target, any_error, 0,
                                    &error));
    meshopt_optimizeVertexCache(indices.data(), indices.data(), indices.size(), indexed.vertices.size());
    const float scale = meshopt_simplifyScale(positions, indexed.vertices.size(), sizeof(Vertex));
    return {target, with_triangles(mesh, indexed, indices), static_cast<double>(error * scale)};
}

} // namespace

std::vector<LevelOfDetail> levels_of_detail(const bake::SourceMesh& mesh,
                                            std::span<const std::size_t> targets) {
    std::vector<std::size_t> descending(targets.begin(), targets.end());
    std::sort(descending.rbegin(), descending.rend());
    std::erase_if(descending, [&mesh](std::size_t target) { return target >= mesh.triangles.size(); });
    std::vector<LevelOfDetail> levels;
    if (descending.empty()) {
        return levels;
    }
    const Indexed indexed = joined(mesh);
    for (const std::size_t target : descending) {
        LevelOfDetail level = simplified(mesh, indexed, target);
        const std::size_t before =
            levels.empty() ? mesh.triangles.size() : levels.back().mesh.triangles.size();
        if (!level.mesh.triangles.empty() && level.mesh.triangles.size() < before) {
            levels.push_back(std::move(level));
        }
    }
    std::reverse(levels.begin(), levels.end());
    return levels;
}

} // namespace frustumscreen::bench
