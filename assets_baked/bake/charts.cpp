#include "assets_baked/bake/charts.h"

#include "assets_baked/bake/atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
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

/// A chart while it grows: its triangles and the plane that it is seen on.
struct GrowingChart {
    glm::vec3 axis_u{0.0F};
    glm::vec3 axis_v{0.0F};
    glm::vec3 direction{0.0F};
    glm::vec2 low{1e30F};
    glm::vec2 high{-1e30F};
    std::vector<std::uint32_t> triangles;

    [[nodiscard]] glm::vec2 project(const glm::vec3& p) const {
        return {glm::dot(p, axis_u), glm::dot(p, axis_v)};
    }
};

/// Chooses in-plane axes with u as level as possible, so that most charts stand upright in the atlas.
void set_direction(GrowingChart& chart, const glm::vec3& direction) {
    chart.direction = direction;
    const glm::vec3 reference = std::abs(direction.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    chart.axis_u = glm::normalize(glm::cross(reference, direction));
    chart.axis_v = glm::cross(direction, chart.axis_u);
}

/// Texel centres that the current chart already covers; one picture is reused by numbered stamps.
class Coverage {
public:
    explicit Coverage(float texel_box)
        : texel_box_(texel_box), side_(static_cast<int>(std::ceil(4.0F / texel_box))),
          stamps_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), 0) {}

    void begin() { ++stamp_; }
    /// Marks the triangle's texel centres; marks nothing and returns false if one of them is taken.
    bool claim(const std::array<glm::vec2, 3>& corners) {
        claimed_.clear();
        const auto edge = [](const glm::vec2& a, const glm::vec2& b, const glm::vec2& p) {
            return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        };
        std::array<glm::vec2, 3> c{};
        for (std::size_t k = 0; k < 3; ++k) {
            c[k] = corners[k] / texel_box_ + static_cast<float>(side_) * 0.5F;
        }
        const glm::vec2 low = glm::min(c[0], glm::min(c[1], c[2]));
        const glm::vec2 high = glm::max(c[0], glm::max(c[1], c[2]));
        for (int y = std::max(0, static_cast<int>(low.y)); y <= std::min(side_ - 1, static_cast<int>(high.y));
             ++y) {
            for (int x = std::max(0, static_cast<int>(low.x));
                 x <= std::min(side_ - 1, static_cast<int>(high.x)); ++x) {
                const glm::vec2 p(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
                if (edge(c[0], c[1], p) <= 0.0F || edge(c[1], c[2], p) <= 0.0F ||
                    edge(c[2], c[0], p) <= 0.0F) {
                    continue;
                }
                const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                                       static_cast<std::size_t>(x);
                if (stamps_[at] == stamp_) {
                    return false;
                }
                claimed_.push_back(at);
            }
        }
        for (const std::size_t at : claimed_) {
            stamps_[at] = stamp_;
        }
        return true;
    }

private:
    float texel_box_;
    int side_;
    std::uint32_t stamp_ = 0;
    std::vector<std::uint32_t> stamps_;
    std::vector<std::size_t> claimed_;
};

/// Grows charts from large triangles over neighbours that face the same way and do not overlap.
class ChartGrower {
public:
    ChartGrower(const TriangleMesh& mesh, float texel_box)
        : mesh_(mesh), across_(neighbours(mesh)), vertex_normals_(smooth_normals(mesh)), coverage_(texel_box),
          taken_(mesh.triangle_count(), 0) {}

    std::vector<GrowingChart> grow() {
        std::vector<float> areas(mesh_.triangle_count());
        for (std::size_t t = 0; t < areas.size(); ++t) {
            areas[t] = glm::length(mesh_.area_normal(t));
        }
        std::vector<std::uint32_t> order(areas.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return areas[a] > areas[b]; });
        std::vector<GrowingChart> charts;
        for (const std::uint32_t seed : order) {
            if (taken_[seed] == 0 && areas[seed] > 0.0F) {
                charts.push_back(grow_from(seed));
            }
        }
        return charts;
    }

private:
    static constexpr float least_facing = 0.5F; // a chart's texels stretch at most twice

    GrowingChart grow_from(std::uint32_t seed) {
        GrowingChart chart;
        const glm::vec3 around = vertex_normals_[mesh_.indices[3 * std::size_t{seed}]] +
                                 vertex_normals_[mesh_.indices[3 * std::size_t{seed} + 1]] +
                                 vertex_normals_[mesh_.indices[3 * std::size_t{seed} + 2]];
        const glm::vec3 own = glm::normalize(mesh_.area_normal(seed));
        const glm::vec3 smooth = glm::length(around) > 0.1F ? glm::normalize(around) : own;
        set_direction(chart, glm::dot(smooth, own) > 0.8F ? smooth : own);
        coverage_.begin();
        add(chart, seed);
        for (std::size_t head = 0; head < chart.triangles.size(); ++head) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t next = across_[3 * std::size_t{chart.triangles[head]} + k];
                if (next != unset && taken_[next] == 0) {
                    add(chart, next);
                }
            }
        }
        return chart;
    }

    void add(GrowingChart& chart, std::uint32_t triangle) {
        const glm::vec3 n = mesh_.area_normal(triangle);
        if (glm::dot(n, chart.direction) < least_facing * glm::length(n)) {
            return;
        }
        std::array<glm::vec2, 3> corners{};
        for (int k = 0; k < 3; ++k) {
            corners[static_cast<std::size_t>(k)] = chart.project(mesh_.corner(triangle, k));
        }
        if (!coverage_.claim(corners)) {
            return;
        }
        for (const glm::vec2& corner : corners) {
            chart.low = glm::min(chart.low, corner);
            chart.high = glm::max(chart.high, corner);
        }
        taken_[triangle] = 1;
        chart.triangles.push_back(triangle);
    }

    const TriangleMesh& mesh_;
    std::vector<std::uint32_t> across_;
    std::vector<glm::vec3> vertex_normals_;
    Coverage coverage_;
    std::vector<std::uint8_t> taken_;
};

glm::ivec2 texels_of(const GrowingChart& chart, float texel_box) {
    const glm::vec2 size = (chart.high - chart.low) / texel_box;
    return glm::ivec2(glm::ceil(size)) + 1 + 2 * chart_gutter_texels;
}

} // namespace

ChartedMesh chart(const TriangleMesh& mesh, float texel_box, int largest_atlas) {
    const std::vector<GrowingChart> charts = ChartGrower(mesh, texel_box).grow();
    AtlasLayout layout;
    for (;; texel_box *= 1.05F) {
        std::vector<glm::ivec2> sizes;
        sizes.reserve(charts.size());
        for (const GrowingChart& chart : charts) {
            sizes.push_back(texels_of(chart, texel_box));
        }
        layout = pack_rectangles(sizes);
        if (layout.width <= largest_atlas && layout.height <= largest_atlas) {
            break;
        }
    }
    ChartedMesh result;
    result.atlas_width = layout.width;
    result.atlas_height = layout.height;
    result.chart_count = charts.size();
    const std::vector<glm::vec3> normals = smooth_normals(mesh);
    std::vector<std::uint32_t> copy_of(mesh.positions.size(), unset);
    std::vector<std::uint32_t> chart_of_copy;
    for (std::uint32_t c = 0; c < charts.size(); ++c) {
        const GrowingChart& chart = charts[c];
        for (const std::uint32_t t : chart.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t vertex = mesh.indices[3 * std::size_t{t} + k];
                if (copy_of[vertex] == unset || chart_of_copy[copy_of[vertex]] != c) {
                    copy_of[vertex] = static_cast<std::uint32_t>(result.positions.size());
                    chart_of_copy.push_back(c);
                    result.positions.push_back(mesh.positions[vertex]);
                    result.normals.push_back(normals[vertex]);
                    result.uv_texels.push_back(
                        (chart.project(mesh.positions[vertex]) - chart.low) / texel_box +
                        glm::vec2(layout.corners[c]) + static_cast<float>(chart_gutter_texels) + 0.5F);
                }
                result.indices.push_back(copy_of[vertex]);
            }
        }
    }
    return result;
}

} // namespace frustumscreen
