#include "app/scene/visible_clusters.h"

#include <cmath>

namespace frustumscreen {

namespace {

bool may_show(const FaceVolume& volume, const PackCluster& cluster, double margin_box) {
    const glm::dvec4 centre(glm::dvec3(cluster.centre), 1.0);
    const double reach = static_cast<double>(cluster.radius) + margin_box;
    for (std::size_t k = 0; k < volume.count; ++k) {
        if (glm::dot(volume.half_spaces[k], centre) < -reach) {
            return false;
        }
    }
    const glm::dvec3 to_apex = glm::dvec3(cluster.cone_apex) - volume.eye;
    // A hair's breadth keeps float-stored cones on the safe side.
    constexpr double hair = 1e-5;
    const double cutoff = static_cast<double>(cluster.cone_cutoff) + hair;
    return cutoff > 1.0 || glm::dot(to_apex, glm::dvec3(cluster.cone_axis)) <= cutoff * glm::length(to_apex);
}

} // namespace

void FaceVolume::add(const glm::dvec4& half_space) {
    const double length = glm::length(glm::dvec3(half_space));
    const glm::dvec4 unit = half_space / length;
    if (length > 0.0 && std::isfinite(unit.x + unit.y + unit.z + unit.w) && count < half_spaces.size()) {
        half_spaces[count++] = unit;
    }
}

void append_visible(const FaceVolume& volume, std::span<const PackCluster> clusters,
                    std::vector<IndexRange>& ranges, double margin_box) {
    const std::size_t begin = ranges.size();
    for (const PackCluster& cluster : clusters) {
        if (!may_show(volume, cluster, margin_box)) {
            continue;
        }
        if (ranges.size() > begin && ranges.back().first + ranges.back().count == cluster.first_index) {
            ranges.back().count += cluster.index_count;
        } else {
            ranges.push_back({cluster.first_index, cluster.index_count});
        }
    }
}

} // namespace frustumscreen
