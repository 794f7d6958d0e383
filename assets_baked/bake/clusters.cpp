#include "assets_baked/bake/clusters.h"

#include <meshoptimizer.h>

namespace frustumscreen::bake {

namespace {

// Clusters are compact rather than flat, because the kiosk checks the side of each triangle itself.
constexpr std::size_t max_vertices = 96;
constexpr std::size_t max_triangles = 64;
constexpr float cone_weight = 0.0F;

pack::PackCluster bounded_by(const meshopt_Bounds& bounds) {
    pack::PackCluster cluster;
    cluster.centre = {bounds.center[0], bounds.center[1], bounds.center[2]};
    cluster.radius = bounds.radius * 1.0001F + 1e-6F;
    if (bounds.cone_cutoff < 1.0F) {
        cluster.cone_apex = {bounds.cone_apex[0], bounds.cone_apex[1], bounds.cone_apex[2]};
        cluster.cone_axis = {bounds.cone_axis[0], bounds.cone_axis[1], bounds.cone_axis[2]};
        cluster.cone_cutoff = bounds.cone_cutoff + 1e-4F; // 32-bit rounding must not cull an edge-on triangle
    }
    return cluster;
}

} // namespace

std::vector<pack::PackCluster> cut_into_clusters(std::span<std::uint32_t> indices,
                                                 std::span<const glm::vec3> positions,
                                                 std::uint32_t first_index) {
    if (indices.empty()) {
        return {};
    }
    const float* coordinates = &positions[0].x;
    meshopt_optimizeVertexCache(indices.data(), indices.data(), indices.size(), positions.size());
    std::vector<meshopt_Meshlet> meshlets(
        meshopt_buildMeshletsBound(indices.size(), max_vertices, max_triangles));
    std::vector<std::uint32_t> vertices(meshlets.size() * max_vertices);
    std::vector<unsigned char> corners(meshlets.size() * max_triangles * 3);
    meshlets.resize(meshopt_buildMeshlets(meshlets.data(), vertices.data(), corners.data(), indices.data(),
                                          indices.size(), coordinates, positions.size(), sizeof(glm::vec3),
                                          max_vertices, max_triangles, cone_weight));
    std::vector<pack::PackCluster> clusters;
    clusters.reserve(meshlets.size());
    std::uint32_t done = 0;
    for (const meshopt_Meshlet& meshlet : meshlets) {
        pack::PackCluster cluster = bounded_by(meshopt_computeMeshletBounds(
            &vertices[meshlet.vertex_offset], &corners[meshlet.triangle_offset], meshlet.triangle_count,
            coordinates, positions.size(), sizeof(glm::vec3)));
        cluster.first_index = first_index + done;
        cluster.index_count = meshlet.triangle_count * 3;
        clusters.push_back(cluster);
        for (std::size_t k = 0; k < cluster.index_count; ++k) {
            indices[done++] = vertices[meshlet.vertex_offset + corners[meshlet.triangle_offset + k]];
        }
    }
    return clusters;
}

} // namespace frustumscreen::bake
