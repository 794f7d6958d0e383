#include "assets_baked/bake/chart_finder.h"

#include "assets_baked/bake/source_scene.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace frustumscreen::bake {

namespace {

constexpr float min_facing = 0.5F;        // a chart's texels are stretched by at most 2
constexpr float min_facing_later = 0.35F; // small triangles of a finer mesh may be steeper

/// For each triangle's edge k (corner k to k + 1), the triangle on its other side, if exactly two meet there.
std::vector<std::uint32_t> neighbours(const TriangleMesh& mesh) {
    std::unordered_map<std::uint64_t, std::uint32_t> open; // directed edge -> 3 * triangle + k
    open.reserve(mesh.indices.size());
    std::vector<std::uint32_t> across(mesh.indices.size(), no_chart);
    const auto end_of = [](std::size_t edge) { return edge - edge % 3 + (edge + 1) % 3; };
    for (std::size_t edge = 0; edge < mesh.indices.size(); ++edge) {
        const std::uint64_t from = mesh.indices[edge];
        const std::uint64_t to = mesh.indices[end_of(edge)];
        const auto twin = open.find((to << 32) | from);
        if (twin != open.end() && across[twin->second] == no_chart) {
            across[edge] = twin->second / 3;
            across[twin->second] = static_cast<std::uint32_t>(edge / 3);
        }
        open.emplace((from << 32) | to, static_cast<std::uint32_t>(edge));
    }
    return across;
}

/// Largest first.
std::vector<std::uint32_t> in_order_of(const std::vector<float>& sizes) {
    std::vector<std::uint32_t> order(sizes.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return sizes[a] > sizes[b]; });
    return order;
}

} // namespace

ChartFinder::ChartFinder(const TriangleMesh& mesh, std::uint32_t number, float texel_box, float stray_box,
                         std::vector<Chart>& charts)
    : mesh_(mesh), number_(number), texel_box_(texel_box), stray_box_(stray_box), charts_(charts),
      across_(neighbours(mesh)), vertex_normals_(smooth_normals(mesh)), areas_(mesh.triangle_count()),
      chart_of_(mesh.triangle_count(), no_chart) {
    for (std::size_t t = 0; t < areas_.size(); ++t) {
        areas_[t] = glm::length(mesh_.area_normal(t));
    }
    large_first_ = in_order_of(areas_);
}

void ChartFinder::take_from(const TriangleMesh& other, const std::vector<std::uint32_t>& other_charts) {
    const std::vector<std::uint32_t> beside = beside_in(other);
    std::vector<std::uint32_t> taken;
    for (std::uint32_t t = 0; t < chart_of_.size(); ++t) {
        // A triangle without area has no chart.
        const std::uint32_t chart = beside[t] != no_chart ? other_charts[beside[t]] : no_chart;
        if (chart != no_chart && take(chart, t, min_facing_later)) {
            taken.push_back(t);
        }
    }
    spread(std::move(taken), min_facing_later);
}

std::vector<std::uint32_t> ChartFinder::find() {
    constexpr int passes = 4; // the last pass changes hardly anything
    const bool is_first = charts_.empty();
    grow_others();
    for (int pass = 0; is_first && pass < passes; ++pass) {
        regrow();
    }
    straighten_borders(is_first ? min_facing : min_facing_later);
    return std::move(chart_of_);
}

bool ChartFinder::take(std::uint32_t chart, std::uint32_t triangle, float facing) {
    const TriangleCorners corners{mesh_.corner(triangle, 0), mesh_.corner(triangle, 1),
                                  mesh_.corner(triangle, 2)};
    const bool taken = charts_[chart].take(corners, number_, stray_box_, facing);
    if (taken) {
        chart_of_[triangle] = chart;
    }
    return taken;
}

/// Offers each triangle's chart to its neighbours without one, and on to theirs.
void ChartFinder::spread(std::vector<std::uint32_t> taken, float facing) {
    for (std::size_t head = 0; head < taken.size(); ++head) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t next = across_[3 * std::size_t{taken[head]} + k];
            if (next != no_chart && chart_of_[next] == no_chart &&
                take(chart_of_[taken[head]], next, facing)) {
                taken.push_back(next);
            }
        }
    }
}

glm::vec3 ChartFinder::direction_at(std::uint32_t seed) const {
    const glm::vec3 around = vertex_normals_[mesh_.indices[3 * std::size_t{seed}]] +
                             vertex_normals_[mesh_.indices[3 * std::size_t{seed} + 1]] +
                             vertex_normals_[mesh_.indices[3 * std::size_t{seed} + 2]];
    const glm::vec3 own = glm::normalize(mesh_.area_normal(seed));
    const glm::vec3 smooth = glm::length(around) > 0.1F ? glm::normalize(around) : own;
    return glm::dot(smooth, own) > 0.8F ? smooth : own;
}

void ChartFinder::grow_from(std::uint32_t seed, const glm::vec3& direction) {
    const auto chart = static_cast<std::uint32_t>(charts_.size());
    charts_.emplace_back(direction, texel_box_);
    seeds_.push_back(seed);
    (void)take(chart, seed, 0.0F);
    spread({seed}, min_facing);
}

void ChartFinder::grow_others() {
    for (const std::uint32_t seed : large_first_) {
        if (chart_of_[seed] == no_chart && areas_[seed] > 0.0F) {
            grow_from(seed, direction_at(seed));
        }
    }
}

/// Only for charts that are all this mesh's own.
void ChartFinder::regrow() {
    std::vector<glm::vec3> means(charts_.size(), glm::vec3(0.0F));
    std::vector<float> sizes(charts_.size(), 0.0F);
    for (std::size_t t = 0; t < chart_of_.size(); ++t) {
        if (chart_of_[t] != no_chart) {
            means[chart_of_[t]] += mesh_.area_normal(t);
            sizes[chart_of_[t]] += areas_[t];
        }
    }
    const std::vector<std::uint32_t> seeds = std::exchange(seeds_, {});
    charts_.clear();
    std::fill(chart_of_.begin(), chart_of_.end(), no_chart);
    for (const std::uint32_t chart : in_order_of(sizes)) {
        const std::uint32_t seed = seeds[chart];
        const float facing = glm::dot(means[chart], mesh_.area_normal(seed));
        if (chart_of_[seed] == no_chart && facing > min_facing * glm::length(means[chart]) * areas_[seed]) {
            grow_from(seed, glm::normalize(means[chart]));
        }
    }
    grow_others();
}

/// Moves a triangle to the chart that two of its neighbours share, if it fits there.
void ChartFinder::straighten_borders(float facing) {
    constexpr int passes = 4;
    for (int pass = 0; pass < passes; ++pass) {
        for (std::uint32_t t = 0; t < chart_of_.size(); ++t) {
            const std::uint32_t chart = chart_of_two_neighbours(t);
            if (chart_of_[t] != no_chart && chart != no_chart && chart != chart_of_[t]) {
                (void)take(chart, t, facing);
            }
        }
    }
}

std::uint32_t ChartFinder::chart_of_two_neighbours(std::uint32_t triangle) const {
    std::array<std::uint32_t, 3> charts{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t next = across_[3 * std::size_t{triangle} + k];
        charts[k] = next != no_chart ? chart_of_[next] : no_chart;
    }
    if (charts[0] == charts[1] || charts[0] == charts[2]) {
        return charts[0];
    }
    return charts[1] == charts[2] ? charts[1] : no_chart;
}

/// For each triangle, the triangle of `other` at its position, on the same side.
std::vector<std::uint32_t> ChartFinder::beside_in(const TriangleMesh& other) const {
    // The two sides of a sheet share positions, so each is lifted slightly to its own side.
    constexpr float lift = 1e-4F;
    TriangleMesh lifted = other;
    const std::vector<glm::vec3> normals = smooth_normals(other);
    for (std::size_t k = 0; k < lifted.positions.size(); ++k) {
        lifted.positions[k] += normals[k] * lift;
    }
    const SourceMesh lifted_mesh = as_source(lifted);
    const std::vector<glm::dvec3> points(lifted.positions.begin(), lifted.positions.end());
    const SourceScene scene(lifted_mesh, points);
    std::vector<std::uint32_t> beside(mesh_.triangle_count(), no_chart);
    parallel_for(beside.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const glm::vec3 normal = mesh_.area_normal(t);
            const float length = glm::length(normal);
            if (length > 0.0F) {
                const glm::vec3 centre =
                    (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3.0F;
                const SurfaceHit hit = scene.facing(centre, normal / length, stray_box_ + 2.0F * lift);
                beside[t] = hit.hit ? hit.triangle : no_chart;
            }
        }
    });
    return beside;
}

} // namespace frustumscreen::bake
