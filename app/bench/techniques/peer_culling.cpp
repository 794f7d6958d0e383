#include "app/bench/techniques/peer_culling.h"

#include "app/scene/face_view.h"
#include "assets_baked/bake/clusters.h"

#include <algorithm>

namespace frustumscreen::bench {

namespace {

/// Makes all triangles visible from both sides.
void face_everywhere(scene::LevelTriangles& level) {
    for (std::vector<float>* part : {&level.normal_x, &level.normal_y, &level.normal_z, &level.distance}) {
        part->assign(level.indices.size() / 3, 0.0F);
    }
    for (pack::PackCluster& cluster : level.clusters) {
        cluster.cone_cutoff = pack::PackCluster{}.cone_cutoff;
    }
}

} // namespace

PeerTriangles peer_triangles(std::span<const glm::vec3> positions_m, const geometry::Box& box,
                             std::span<const std::span<std::uint32_t>> parts, bool closed) {
    PeerTriangles mesh;
    const glm::dvec3 size = box.high - box.low;
    mesh.metres_per_box = std::max({size.x, size.y, size.z, 1e-12});
    scene::LevelTriangles& all = mesh.triangles;
    for (const glm::vec3& position : positions_m) {
        all.positions.emplace_back(glm::dvec3(position) / mesh.metres_per_box);
    }
    for (const std::span<std::uint32_t> part : parts) {
        mesh.first_cluster.push_back(all.clusters.size());
        const auto first_index = static_cast<std::uint32_t>(all.indices.size());
        const std::vector<pack::PackCluster> clusters =
            bake::cut_into_clusters(part, all.positions, first_index);
        all.clusters.insert(all.clusters.end(), clusters.begin(), clusters.end());
        all.indices.insert(all.indices.end(), part.begin(), part.end());
    }
    mesh.first_cluster.push_back(all.clusters.size());
    (closed ? scene::find_planes : face_everywhere)(all);
    scene::find_extents(all);
    return mesh;
}

void VisibleParts::find(const PeerTriangles& mesh, const geometry::Box& box, const PeerView& view) {
    const scene::LevelTriangles& level = mesh.triangles;
    front_.forget();
    front_.update(level, view.eye_m / mesh.metres_per_box);
    indices_.clear();
    faces_.clear();
    ranges_.clear();
    lit_.begin(view.projector.width, view.projector.height);
    for (PeerFace& face : faces_before(box, view)) {
        glm::dmat4 clip_from_box = face.clip_from_prop;
        for (int axis = 0; axis < 3; ++axis) {
            clip_from_box[axis] *= mesh.metres_per_box;
        }
        const scene::FaceVolume volume = scene::volume_of(*face.face, view.eye_m, glm::dmat4(1.0),
                                                          mesh.metres_per_box, clip_from_box, view.projector);
        const glm::mat4 clip(clip_from_box);
        std::vector<scene::IndexRange> ranges;
        PixelRectangle bounds;
        for (std::size_t part = 0; part + 1 < mesh.first_cluster.size(); ++part) {
            const std::size_t first = indices_.size();
            for (std::size_t k = mesh.first_cluster[part]; k < mesh.first_cluster[part + 1]; ++k) {
                const std::size_t begin = indices_.size();
                if (scene::append_visible(volume, level, front_, k, indices_) > 0) {
                    bounds = united(bounds, scene::light_tiles(level, k, std::span(indices_).subspan(begin),
                                                               clip, face.bounds, view.projector, lit_));
                }
            }
            ranges.push_back(
                {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(indices_.size() - first)});
        }
        if (!bounds.empty()) {
            face.bounds = bounds;
            faces_.push_back(face);
            ranges_.push_back(std::move(ranges));
        }
    }
    lit_.finish();
    glBindVertexArray(0); // a bound vertex array would store the next binding
    bind();
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices_.size() * sizeof(std::uint32_t)),
                 indices_.data(), GL_STREAM_DRAW);
}

} // namespace frustumscreen::bench
