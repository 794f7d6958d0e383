#include "app/pack/check_pack.h"
#include "app/pack/container/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::pack {

namespace {

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_sound(const PackCluster& cluster) {
    return is_finite(cluster.centre) && std::isfinite(cluster.radius) && cluster.radius >= 0.0F &&
           is_finite(cluster.cone_apex) && is_finite(cluster.cone_axis) && std::isfinite(cluster.cone_cutoff);
}

Result<void> check_clusters(const PackLevel& level) {
    std::uint64_t next = 0;
    for (std::size_t k = 0; k < level.clusters.size(); ++k) {
        TRY_VOID(check_cluster(level.clusters[k], k, next));
        next += level.clusters[k].index_count;
    }
    if (next != level.indices.size()) {
        return bad_input("level.clusters_cover", "the clusters cover {} indices, the level has {}", next,
                         level.indices.size());
    }
    return {};
}

Result<void> check_errors(const LevelError& error) {
    const auto allowed = [](float value, float most) { return value >= 0.0F && value <= most; };
    if (!allowed(error.mean_box, max_error_box) || !allowed(error.p95_box, max_error_box) ||
        !allowed(error.max_box, max_error_box) || !allowed(error.colour_rmse, max_colour_rmse)) {
        return bad_input("level.error_range",
                         "its error is {} mean, {} p95, {} max, {} colour; allowed are 0 to {} and colour 0 "
                         "to {}",
                         error.mean_box, error.p95_box, error.max_box, error.colour_rmse, max_error_box,
                         max_colour_rmse);
    }
    return {};
}

Result<void> check_level(const Pack& pack, const PackLevel& level) {
    if (level.texture >= pack.textures.size()) {
        return bad_input("level.texture", "its texture is number {}, the pack has {} textures", level.texture,
                         pack.textures.size());
    }
    const image::Image8& texture = pack.textures[level.texture];
    if (level.technique == LevelTechnique::Relief &&
        (texture.width != pack.relief.relief.width || texture.height != pack.relief.relief.height)) {
        return bad_input("level.texture_size",
                         "its texture is {} x {} texels, the relief {} x {}; a relief level needs the same",
                         texture.width, texture.height, pack.relief.relief.width, pack.relief.relief.height);
    }
    TRY_VOID(check_errors(level.error));
    return check_mesh(level);
}

} // namespace

Result<void> check_cluster(const PackCluster& cluster, std::size_t k, std::uint64_t first) {
    if (cluster.first_index != first || cluster.index_count == 0 || cluster.index_count % 3 != 0) {
        return bad_input("level.cluster_range",
                         "cluster {} has {} indices from {} on; allowed is a multiple of 3 from {} on", k,
                         cluster.index_count, cluster.first_index, first);
    }
    if (!is_sound(cluster)) {
        return bad_input("level.cluster_bound", "cluster {} has a bound that is not a finite number", k);
    }
    return {};
}

Result<void> check_mesh(const PackLevel& level) {
    if (level.vertices.size() > max_vertices || level.indices.size() > max_indices ||
        level.clusters.size() > max_clusters || level.indices.empty() || level.indices.size() % 3 != 0) {
        return bad_input("level.counts",
                         "it has {} vertices, {} indices, {} clusters; allowed are {}, {} (a multiple of 3, "
                         "not 0), {}",
                         level.vertices.size(), level.indices.size(), level.clusters.size(), max_vertices,
                         max_indices, max_clusters);
    }
    const std::uint32_t highest = *std::max_element(level.indices.begin(), level.indices.end());
    if (highest >= level.vertices.size()) {
        return bad_input("level.index", "an index is {}, the level has {} vertices", highest,
                         level.vertices.size());
    }
    const bool reserved = std::any_of(level.vertices.begin(), level.vertices.end(),
                                      [](const PackVertex& vertex) { return vertex.reserved != 0; });
    if (reserved) {
        return bad_input("level.reserved", "a vertex has its reserved bytes set; allowed is 0");
    }
    return check_clusters(level);
}

Result<void> check_level_count(const PackDescription& pack, std::size_t levels) {
    if (levels == 0 || levels > max_levels) {
        return bad_input("pack.level_count", "the pack has {} levels, allowed are 1 to {}", levels,
                         max_levels);
    }
    if (pack.default_level >= levels) {
        return bad_input("pack.default_level", "default_level is {}, the pack has {} levels",
                         pack.default_level, levels);
    }
    return {};
}

Result<void> check_levels(const Pack& pack, Read read) {
    TRY_VOID(check_level_count(pack, pack.levels.size()));
    bool uses_relief = false;
    for (std::size_t k = 0; k < pack.levels.size(); ++k) {
        const bool skipped = read == Read::Chosen && pack.levels[k].indices.empty();
        TRY_VOID(at(fmt::format("level {}", k),
                    skipped ? check_errors(pack.levels[k].error) : check_level(pack, pack.levels[k])));
        uses_relief = uses_relief || pack.levels[k].technique == LevelTechnique::Relief;
    }
    if (!uses_relief && !pack.relief.relief.texels.empty()) {
        return bad_input("pack.unused_relief", "the pack holds a relief that no level uses");
    }
    return {};
}

} // namespace frustumscreen::pack
