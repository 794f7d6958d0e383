#include "app/bench/techniques/peer_culling.h"

#include "assets_baked/bake/clusters.h"

#include <algorithm>

namespace frustumscreen {

namespace {

/// All triangles are seen from both sides.
void face_everywhere(LevelTriangles& level) {
    for (std::vector<float>* part : {&level.normal_x, &level.normal_y, &level.normal_z, &level.distance}) {
        part->assign(level.indices.size() / 3, 0.0F);
    }
    for (PackCluster& cluster : level.clusters) {
        cluster.cone_cutoff = PackCluster{}.cone_cutoff;
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
    LevelTriangles& all = mesh.triangles;
    for (const glm::vec3& position : positions_m) {
        all.positions.emplace_back((glm::dvec3(position) - mesh.low_m) / mesh.metres_per_box);
    }
    for (const std::span<std::uint32_t> part : parts) {
        mesh.first_cluster.push_back(all.clusters.size());
        const auto first_index = static_cast<std::uint32_t>(all.indices.size());
        const std::vector<PackCluster> clusters = cut_into_clusters(part, all.positions, first_index);
        all.clusters.insert(all.clusters.end(), clusters.begin(), clusters.end());
        all.indices.insert(all.indices.end(), part.begin(), part.end());
    }
    mesh.first_cluster.push_back(all.clusters.size());
    (closed ? find_planes : face_everywhere)(all);
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
    glBindVertexArray(0); // a bound vertex array would store the next binding
    bind();
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices_.size() * sizeof(std::uint32_t)),
                 indices_.data(), GL_STREAM_DRAW);
}

} // namespace frustumscreen
