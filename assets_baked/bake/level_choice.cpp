#include "assets_baked/bake/level_choice.h"

#include "assets_baked/bake/level.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace frustumscreen::bake {

namespace {

pack::LevelOutline outline_of(const Surface& surface) {
    return {.technique = pack::LevelTechnique::Mesh,
            .error = surface.error,
            .triangles = surface.mesh.triangle_count(),
            .vertices = 0,
            .texture = 0};
}

pack::LevelOutline outline_of(const pack::PackLevel& level) {
    return {.technique = level.technique,
            .error = level.error,
            .triangles = level.indices.size() / 3,
            .vertices = level.vertices.size(),
            .texture = 0};
}

template <typename Level>
std::vector<std::size_t> front_of(const std::vector<Level>& levels, float worst_mean) {
    std::vector<pack::LevelOutline> outlines;
    outlines.reserve(levels.size());
    for (const Level& level : levels) {
        outlines.push_back(outline_of(level));
    }
    return measured_front(outlines, worst_mean);
}

/// True if the mean error is smaller and neither the 95th percentile nor the colour error is clearly larger.
bool betters(const pack::LevelError& dearer, const pack::LevelError& cheaper) {
    constexpr float scatter = 1.1F; // scatter of a measure over random points
    constexpr float min_rmse = 1.0F;
    return dearer.mean_box < cheaper.mean_box && dearer.p95_box < scatter * cheaper.p95_box &&
           dearer.colour_rmse < scatter * cheaper.colour_rmse + min_rmse;
}

} // namespace

std::vector<std::size_t> measured_front(const std::vector<pack::LevelOutline>& levels, float worst_mean) {
    constexpr std::uint64_t few_triangles = 1500; // fewer triangles do not make a frame cheaper
    std::vector<std::size_t> order(levels.size());
    std::iota(order.begin(), order.end(), 0);
    const auto rank = [&](std::size_t k) {
        const pack::LevelOutline& level = levels[k];
        return std::tuple(std::max(level.triangles, few_triangles), level.error.mean_box, level.triangles);
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    float nearest = std::numeric_limits<float>::infinity();
    for (const pack::LevelOutline& level : levels) {
        nearest = std::min(nearest, level.error.mean_box);
    }
    std::erase_if(order,
                  [&](std::size_t k) { return levels[k].error.mean_box > std::max(worst_mean, nearest); });
    std::vector<std::size_t> front;
    for (const std::size_t k : order) {
        if (front.empty() || betters(levels[k].error, levels[front.back()].error)) {
            front.push_back(k);
        }
    }
    return front;
}

void keep_front(std::vector<Surface>& surfaces, float worst_mean) {
    std::vector<Surface> kept;
    for (const std::size_t k : front_of(surfaces, worst_mean)) {
        kept.insert(kept.begin(), std::move(surfaces[k]));
    }
    surfaces = std::move(kept);
}

void keep(pack::Pack& pack, TexturedLevels meshes, float worst_mean) {
    for (const std::size_t k : front_of(meshes.levels, worst_mean)) {
        pack.levels.push_back(std::move(meshes.levels[k]));
    }
    pack.textures.push_back(std::move(meshes.texture));
}

std::uint32_t choose_default(const pack::Pack& pack, const pack::SeenErrors& seen, double mm_per_box) {
    constexpr std::size_t free_triangles = 30'000;
    std::uint32_t level = 0;
    while (level + 2 < pack.levels.size() && pack.levels[level + 1].indices.size() / 3 <= free_triangles) {
        ++level;
    }
    const auto good = [&](std::uint32_t one) {
        return good_enough(pack.levels[one].error, mean_of(seen.levels[one]), mm_per_box);
    };
    while (level + 1 < pack.levels.size() && !good(level)) {
        ++level;
    }
    return level;
}

} // namespace frustumscreen::bake
