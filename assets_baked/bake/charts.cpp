#include "assets_baked/bake/charts.h"

#include "assets_baked/bake/atlas.h"
#include "assets_baked/bake/source_scene.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

namespace frustumscreen {

namespace {

constexpr std::uint32_t unset = 0xFFFFFFFFU;

/// For each triangle's edge k (corner k to k + 1) the triangle on its other side, where exactly two meet
/// there.
std::vector<std::uint32_t> neighbours(const TriangleMesh& mesh) {
    std::unordered_map<std::uint64_t, std::uint32_t> open; // directed edge -> 3 * triangle + k
    open.reserve(mesh.indices.size());
    std::vector<std::uint32_t> across(mesh.indices.size(), unset);
    const auto end_of = [](std::size_t edge) { return edge - edge % 3 + (edge + 1) % 3; };
    for (std::size_t edge = 0; edge < mesh.indices.size(); ++edge) {
        const std::uint64_t from = mesh.indices[edge];
        const std::uint64_t to = mesh.indices[end_of(edge)];
        const auto twin = open.find((to << 32) | from);
        if (twin != open.end() && across[twin->second] == unset) {
            across[edge] = twin->second / 3;
            across[twin->second] = static_cast<std::uint32_t>(edge / 3);
        }
        open.emplace((from << 32) | to, static_cast<std::uint32_t>(edge));
    }
    return across;
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

TriangleCorners corners_of(const TriangleMesh& mesh, std::size_t triangle) {
    return {mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2)};
}

/// Finds charts for the triangles of one mesh.
class ChartFinder {
public:
    ChartFinder(const TriangleMesh& mesh, std::uint32_t number, float texel_box, float stray_box,
                std::vector<Chart>& charts)
        : mesh_(mesh), number_(number), texel_box_(texel_box), stray_box_(stray_box), charts_(charts),
          across_(neighbours(mesh)), vertex_normals_(smooth_normals(mesh)),
          chart_of_(mesh.triangle_count(), unset) {}

    /// Takes the charts that another mesh has at the same place, then those of the neighbours.
    void take_from(const TriangleMesh& other, const std::vector<std::uint32_t>& other_charts) {
        const std::vector<std::uint32_t> beside = beside_in(other);
        std::vector<std::uint32_t> taken;
        for (std::uint32_t t = 0; t < chart_of_.size(); ++t) {
            if (beside[t] != unset && take(other_charts[beside[t]], t, least_facing_later)) {
                taken.push_back(t);
            }
        }
        for (std::size_t head = 0; head < taken.size(); ++head) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t next = across_[3 * std::size_t{taken[head]} + k];
                if (next != unset && chart_of_[next] == unset &&
                    take(chart_of_[taken[head]], next, least_facing_later)) {
                    taken.push_back(next);
                }
            }
        }
    }

    /// Grows new charts from large triangles over neighbours that face the same way and do not overlap.
    std::vector<std::uint32_t> found_charts() {
        std::vector<float> areas(mesh_.triangle_count());
        for (std::size_t t = 0; t < areas.size(); ++t) {
            areas[t] = glm::length(mesh_.area_normal(t));
        }
        std::vector<std::uint32_t> order(areas.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return areas[a] > areas[b]; });
        for (const std::uint32_t seed : order) {
            if (chart_of_[seed] == unset && areas[seed] > 0.0F) {
                grow_from(seed);
            }
        }
        return std::move(chart_of_);
    }

private:
    static constexpr float least_facing = 0.5F;        // a chart's texels stretch at most twice
    static constexpr float least_facing_later = 0.35F; // small triangles of a finer mesh may be steeper

    bool take(std::uint32_t chart, std::uint32_t triangle, float facing) {
        const bool taken = charts_[chart].take(corners_of(mesh_, triangle), number_, stray_box_, facing);
        chart_of_[triangle] = taken ? chart : unset;
        return taken;
    }

    void grow_from(std::uint32_t seed) {
        const glm::vec3 around = vertex_normals_[mesh_.indices[3 * std::size_t{seed}]] +
                                 vertex_normals_[mesh_.indices[3 * std::size_t{seed} + 1]] +
                                 vertex_normals_[mesh_.indices[3 * std::size_t{seed} + 2]];
        const glm::vec3 own = glm::normalize(mesh_.area_normal(seed));
        const glm::vec3 smooth = glm::length(around) > 0.1F ? glm::normalize(around) : own;
        const auto chart = static_cast<std::uint32_t>(charts_.size());
        charts_.emplace_back(glm::dot(smooth, own) > 0.8F ? smooth : own, texel_box_);
        take(chart, seed, 0.0F);
        std::vector<std::uint32_t> taken{seed};
        for (std::size_t head = 0; head < taken.size(); ++head) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t next = across_[3 * std::size_t{taken[head]} + k];
                if (next != unset && chart_of_[next] == unset && take(chart, next, least_facing)) {
                    taken.push_back(next);
                }
            }
        }
    }

    /// For each triangle the one of `other` at its place, on the same side.
    [[nodiscard]] std::vector<std::uint32_t> beside_in(const TriangleMesh& other) const {
        // The two sides of a sheet share positions: each is moved a little to its own side.
        constexpr float lift = 1e-4F;
        TriangleMesh lifted = other;
        const std::vector<glm::vec3> normals = smooth_normals(other);
        for (std::size_t k = 0; k < lifted.positions.size(); ++k) {
            lifted.positions[k] += normals[k] * lift;
        }
        const SourceMesh lifted_mesh = as_source(lifted);
        const std::vector<glm::dvec3> points(lifted.positions.begin(), lifted.positions.end());
        const SourceScene scene(lifted_mesh, points);
        std::vector<std::uint32_t> beside(mesh_.triangle_count(), unset);
        parallel_for(beside.size(), 256, [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t) {
                const glm::vec3 normal = mesh_.area_normal(t);
                const float length = glm::length(normal);
                if (length > 0.0F) {
                    const glm::vec3 centre =
                        (mesh_.corner(t, 0) + mesh_.corner(t, 1) + mesh_.corner(t, 2)) / 3.0F;
                    const SurfaceHit hit = scene.facing(centre, normal / length, stray_box_ + 2.0F * lift);
                    beside[t] = hit.hit ? hit.triangle : unset;
                }
            }
        });
        return beside;
    }

    const TriangleMesh& mesh_;
    std::uint32_t number_;
    float texel_box_;
    float stray_box_;
    std::vector<Chart>& charts_;
    std::vector<std::uint32_t> across_;
    std::vector<glm::vec3> vertex_normals_;
    std::vector<std::uint32_t> chart_of_;
};

/// A chart's rectangle: turned so that it is small.
struct Rectangle {
    glm::vec2 turn{1.0F, 0.0F}; ///< cosine and sine
    glm::vec2 low{0.0F};
    glm::vec2 high{0.0F};

    [[nodiscard]] glm::vec2 turned(const glm::vec2& p) const {
        return {turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y};
    }
    [[nodiscard]] glm::ivec2 texels(float shrink) const {
        return glm::ivec2(glm::ceil((high - low) * shrink)) + 1 + 2 * chart_gutter_texels;
    }
};

Rectangle smallest_around(const std::vector<glm::vec2>& points) {
    constexpr int turns = 36; // of a quarter
    Rectangle smallest;
    double smallest_area = 1e300;
    for (int k = 0; k < turns; ++k) {
        const double angle = 0.5 * std::numbers::pi * k / turns;
        Rectangle around{glm::vec2(std::cos(angle), std::sin(angle)), glm::vec2(1e30F), glm::vec2(-1e30F)};
        for (const glm::vec2& p : points) {
            around.low = glm::min(around.low, around.turned(p));
            around.high = glm::max(around.high, around.turned(p));
        }
        const glm::dvec2 size(around.texels(1.0F));
        if (size.x * size.y < smallest_area) {
            smallest_area = size.x * size.y;
            smallest = around;
        }
    }
    return smallest;
}

/// A chart's place in the atlas.
struct Place {
    Rectangle rectangle;
    glm::vec2 corner{0.0F};
    float shrink = 1.0F; ///< where the atlas would be too large

    [[nodiscard]] glm::vec2 texel(const glm::vec2& projected) const {
        return (rectangle.turned(projected) - rectangle.low) * shrink + corner +
               static_cast<float>(chart_gutter_texels) + 0.5F;
    }
};

std::vector<glm::ivec2> sizes_of(const std::vector<Rectangle>& rectangles, float shrink) {
    std::vector<glm::ivec2> sizes;
    sizes.reserve(rectangles.size());
    for (const Rectangle& rectangle : rectangles) {
        sizes.push_back(rectangle.texels(shrink));
    }
    return sizes;
}

double area_of(const std::vector<glm::ivec2>& sizes) {
    return std::accumulate(sizes.begin(), sizes.end(), 0.0, [](double sum, const glm::ivec2& size) {
        return sum + static_cast<double>(size.x) * size.y;
    });
}

std::vector<Place> places_of(const std::vector<Rectangle>& rectangles, int largest_atlas,
                             AtlasLayout& layout) {
    constexpr float step = 1.05F;
    const double most_texels = static_cast<double>(largest_atlas) * largest_atlas;
    float shrink = 1.0F;
    if (area_of(sizes_of(rectangles, 1e-3F)) < 0.5 * most_texels) { // else it is gutters that fill the atlas
        while (area_of(sizes_of(rectangles, shrink)) > most_texels) {
            shrink /= step;
        }
        while (layout = pack_rectangles(sizes_of(rectangles, shrink)),
               std::max(layout.width, layout.height) > largest_atlas) {
            shrink /= step;
        }
    } else {
        layout = pack_rectangles(sizes_of(rectangles, shrink));
    }
    std::vector<Place> places;
    places.reserve(rectangles.size());
    for (std::size_t c = 0; c < rectangles.size(); ++c) {
        places.push_back({rectangles[c], glm::vec2(layout.corners[c]), shrink});
    }
    return places;
}

/// Splits the vertices at chart borders.
ChartedMesh split(const TriangleMesh& mesh, const std::vector<std::uint32_t>& chart_of,
                  const std::vector<Chart>& charts, const std::vector<Place>& places) {
    ChartedMesh result;
    result.chart_count = charts.size();
    const std::vector<glm::vec3> normals = smooth_normals(mesh);
    std::vector<std::uint32_t> copy_of(mesh.positions.size(), unset);
    std::vector<std::uint32_t> chart_of_copy;
    std::vector<std::uint32_t> order(chart_of.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return chart_of[a] < chart_of[b]; });
    for (const std::uint32_t t : order) {
        const std::uint32_t c = chart_of[t];
        for (std::size_t k = 0; c != unset && k < 3; ++k) {
            const std::uint32_t vertex = mesh.indices[3 * std::size_t{t} + k];
            if (copy_of[vertex] == unset || chart_of_copy[copy_of[vertex]] != c) {
                copy_of[vertex] = static_cast<std::uint32_t>(result.positions.size());
                chart_of_copy.push_back(c);
                result.positions.push_back(mesh.positions[vertex]);
                result.normals.push_back(normals[vertex]);
                result.uv_texels.push_back(places[c].texel(charts[c].project(mesh.positions[vertex])));
            }
            result.indices.push_back(copy_of[vertex]);
        }
    }
    return result;
}

} // namespace

void SharedCharts::add(const TriangleMesh& mesh, float stray_box) {
    if (added_.empty()) {
        double surface_box2 = 0.0;
        for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
            surface_box2 += 0.5 * static_cast<double>(glm::length(mesh.area_normal(t)));
        }
        // So many texels the atlas cannot have; without this the charts would take memory in vain.
        texel_box_ = std::max(texel_box_, static_cast<float>(std::sqrt(0.5 * surface_box2) / largest_atlas_));
    }
    ChartFinder finder(mesh, static_cast<std::uint32_t>(added_.size()) + 1, texel_box_, stray_box, charts_);
    if (!added_.empty()) {
        finder.take_from(added_.back().mesh, added_.back().chart_of);
    }
    added_.push_back({mesh, finder.found_charts()});
}

std::vector<ChartedMesh> SharedCharts::lay_out() const {
    std::vector<std::vector<glm::vec2>> points(charts_.size());
    for (const Added& added : added_) {
        for (std::size_t k = 0; k < added.mesh.indices.size(); ++k) {
            if (const std::uint32_t c = added.chart_of[k / 3]; c != unset) {
                points[c].push_back(charts_[c].project(added.mesh.positions[added.mesh.indices[k]]));
            }
        }
    }
    std::vector<Rectangle> rectangles(points.size());
    parallel_for(points.size(), 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            rectangles[c] = smallest_around(points[c]);
        }
    });
    AtlasLayout layout;
    const std::vector<Place> places = places_of(rectangles, largest_atlas_, layout);
    std::vector<ChartedMesh> meshes;
    for (const Added& added : added_) {
        meshes.push_back(split(added.mesh, added.chart_of, charts_, places));
        meshes.back().atlas_width = layout.width;
        meshes.back().atlas_height = layout.height;
    }
    return meshes;
}

ChartedMesh chart(const TriangleMesh& mesh, float texel_box, int largest_atlas) {
    SharedCharts charts(texel_box, largest_atlas);
    charts.add(mesh, 0.0F);
    return charts.lay_out().front();
}

ChartedMesh joined(std::span<const ChartedMesh> meshes) {
    ChartedMesh result;
    for (const ChartedMesh& mesh : meshes) {
        result.atlas_width = mesh.atlas_width;
        result.atlas_height = mesh.atlas_height;
        result.chart_count = mesh.chart_count;
        const auto first = static_cast<std::uint32_t>(result.positions.size());
        result.positions.insert(result.positions.end(), mesh.positions.begin(), mesh.positions.end());
        result.normals.insert(result.normals.end(), mesh.normals.begin(), mesh.normals.end());
        result.uv_texels.insert(result.uv_texels.end(), mesh.uv_texels.begin(), mesh.uv_texels.end());
        for (const std::uint32_t index : mesh.indices) {
            result.indices.push_back(first + index);
        }
    }
    return result;
}

} // namespace frustumscreen
