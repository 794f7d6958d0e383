#include "app/bench/peer_culling.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace frustumscreen {

namespace {

// As the bake cuts the pack's levels: compact rather than flat.
constexpr std::size_t most_vertices = 96;
constexpr std::size_t most_triangles = 64;
constexpr float cone_weight = 0.0F;

PackCluster bounds_of(const meshopt_Bounds& bounds, bool closed) {
    PackCluster cluster;
    cluster.centre = {bounds.center[0], bounds.center[1], bounds.center[2]};
    cluster.radius = bounds.radius * 1.0001F + 1e-6F;
    if (closed && bounds.cone_cutoff < 1.0F) {
        cluster.cone_apex = {bounds.cone_apex[0], bounds.cone_apex[1], bounds.cone_apex[2]};
        cluster.cone_axis = {bounds.cone_axis[0], bounds.cone_axis[1], bounds.cone_axis[2]};
        cluster.cone_cutoff = bounds.cone_cutoff + 1e-4F; // 32-bit rounding must not cull an edge-on triangle
    }
    return cluster;
}

/// Cuts one part into clusters behind those of the parts before.
void add_clusters(std::span<std::uint32_t> indices, bool closed, LevelTriangles& level) {
    if (indices.empty()) {
        return;
    }
    const float* positions = &level.positions[0].x;
    const std::size_t count = level.positions.size();
    meshopt_optimizeVertexCache(indices.data(), indices.data(), indices.size(), count);
    std::vector<meshopt_Meshlet> meshlets(
        meshopt_buildMeshletsBound(indices.size(), most_vertices, most_triangles));
    std::vector<std::uint32_t> vertices(meshlets.size() * most_vertices);
    std::vector<unsigned char> corners(meshlets.size() * most_triangles * 3);
    meshlets.resize(meshopt_buildMeshlets(meshlets.data(), vertices.data(), corners.data(), indices.data(),
                                          indices.size(), positions, count, sizeof(glm::vec3), most_vertices,
                                          most_triangles, cone_weight));
    auto out = indices.begin();
    for (const meshopt_Meshlet& meshlet : meshlets) {
        PackCluster cluster = bounds_of(
            meshopt_computeMeshletBounds(&vertices[meshlet.vertex_offset], &corners[meshlet.triangle_offset],
                                         meshlet.triangle_count, positions, count, sizeof(glm::vec3)),
            closed);
        cluster.first_index = static_cast<std::uint32_t>(level.indices.size());
        cluster.index_count = meshlet.triangle_count * 3;
        level.clusters.push_back(cluster);
        for (std::size_t k = 0; k < cluster.index_count; ++k) {
            *out = vertices[meshlet.vertex_offset + corners[meshlet.triangle_offset + k]];
            level.indices.push_back(*out++);
        }
    }
}

/// A triangle of no area faces everywhere; so do all of a mesh that is not closed.
void add_planes(bool closed, LevelTriangles& level) {
    for (std::size_t first = 0; first + 2 < level.indices.size(); first += 3) {
        const glm::dvec3 a(level.positions[level.indices[first]]);
        const glm::dvec3 b(level.positions[level.indices[first + 1]]);
        const glm::dvec3 c(level.positions[level.indices[first + 2]]);
        const glm::dvec3 area_normal = glm::cross(b - a, c - a);
        const double length = glm::length(area_normal);
        const glm::dvec3 normal = closed && length > 0.0 ? area_normal / length : glm::dvec3(0.0);
        level.normal_x.push_back(static_cast<float>(normal.x));
        level.normal_y.push_back(static_cast<float>(normal.y));
        level.normal_z.push_back(static_cast<float>(normal.z));
        level.distance.push_back(static_cast<float>(glm::dot(normal, a)));
    }
}

/// The pyramid eye -> face.
FaceVolume pyramid_of(const PropFace& face, const PeerTriangles& mesh, const glm::dvec3& eye_box) {
    FaceVolume volume;
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
        const glm::dvec3 a = (face.corners[k] - mesh.low_m) / mesh.metres_per_box - eye_box;
        const glm::dvec3 b =
            (face.corners[(k + 1) % face.corners.size()] - mesh.low_m) / mesh.metres_per_box - eye_box;
        const glm::dvec3 inward = glm::cross(b, a);
        volume.add(glm::dvec4(inward, -glm::dot(inward, eye_box)));
    }
    return volume;
}

} // namespace

PeerTriangles peer_triangles(std::span<const glm::vec3> positions_m, const Box& box,
                             std::span<const std::span<std::uint32_t>> parts, bool closed) {
    PeerTriangles mesh;
    mesh.low_m = box.low;
    const glm::dvec3 size = box.high - box.low;
    mesh.metres_per_box = std::max({size.x, size.y, size.z, 1e-12});
    for (const glm::vec3& position : positions_m) {
        mesh.triangles.positions.emplace_back((glm::dvec3(position) - mesh.low_m) / mesh.metres_per_box);
    }
    for (const std::span<std::uint32_t> part : parts) {
        mesh.first_cluster.push_back(mesh.triangles.clusters.size());
        add_clusters(part, closed, mesh.triangles);
    }
    mesh.first_cluster.push_back(mesh.triangles.clusters.size());
    add_planes(closed, mesh.triangles);
    return mesh;
}

void VisibleParts::find(const PeerTriangles& mesh, const PeerView& view) {
    const glm::dvec3 eye_box = (view.eye_m - mesh.low_m) / mesh.metres_per_box;
    front_.forget();
    front_.update(mesh.triangles, eye_box);
    indices_.clear();
    ranges_.assign(view.faces.size(), {});
    for (std::size_t face = 0; face < view.faces.size(); ++face) {
        const FaceVolume volume = pyramid_of(*view.faces[face], mesh, eye_box);
        for (std::size_t part = 0; part + 1 < mesh.first_cluster.size(); ++part) {
            const auto first = static_cast<std::uint32_t>(indices_.size());
            for (std::size_t k = mesh.first_cluster[part]; k < mesh.first_cluster[part + 1]; ++k) {
                append_visible(volume, mesh.triangles, front_, k, indices_);
            }
            ranges_[face].push_back({first, static_cast<std::uint32_t>(indices_.size()) - first});
        }
    }
    glBindVertexArray(0); // a vertex array keeps the buffer that is bound while it is
    bind();
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices_.size() * sizeof(std::uint32_t)),
                 indices_.data(), GL_STREAM_DRAW);
}

} // namespace frustumscreen
