#include "assets_baked/bake/charts.h"

#include "assets_baked/bake/atlas.h"
#include "assets_baked/bake/chart_finder.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace frustumscreen::bake {

namespace {

/// A chart's rectangle, rotated to be small.
struct Rectangle {
    glm::vec2 turn{1.0F, 0.0F}; ///< cosine and sine
    glm::vec2 low{0.0F};
    glm::vec2 high{0.0F};

    [[nodiscard]] glm::vec2 turned(const glm::vec2& p) const {
        return {turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y};
    }
    [[nodiscard]] glm::ivec2 texels(float shrink) const {
        if (low.x > high.x) {
            return glm::ivec2(0); // the chart has become empty
        }
        return glm::ivec2(glm::ceil((high - low) * shrink)) + 1 + 2 * chart_gutter_texels;
    }
};

Rectangle smallest_around(const std::vector<glm::vec2>& points) {
    constexpr int turns = 36; // per quarter turn
    if (points.empty()) {
        return {{1.0F, 0.0F}, glm::vec2(0.0F), glm::vec2(-1.0F)};
    }
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

/// A chart's position in the atlas.
struct Place {
    Rectangle rectangle;
    glm::vec2 corner{0.0F};
    float shrink = 1.0F; ///< less than 1 if the atlas would be too large

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
    const double max_texels = static_cast<double>(largest_atlas) * largest_atlas;
    float shrink = 1.0F;
    if (area_of(sizes_of(rectangles, 1e-3F)) < 0.5 * max_texels) { // otherwise the gutters fill the atlas
        while (area_of(sizes_of(rectangles, shrink)) > max_texels) {
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
    const std::vector<glm::vec3> normals = corner_normals(mesh);
    constexpr std::uint32_t none = 0xFFFFFFFFU;
    std::vector<std::uint32_t> copy_of(mesh.positions.size(), none);
    std::vector<std::uint32_t> chart_of_copy;
    std::vector<std::uint32_t> order(chart_of.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return chart_of[a] < chart_of[b]; });
    for (const std::uint32_t t : order) {
        const std::uint32_t c = chart_of[t];
        for (std::size_t k = 0; c != no_chart && k < 3; ++k) {
            const std::uint32_t vertex = mesh.indices[3 * std::size_t{t} + k];
            if (copy_of[vertex] == none || chart_of_copy[copy_of[vertex]] != c) {
                copy_of[vertex] = static_cast<std::uint32_t>(result.positions.size());
                chart_of_copy.push_back(c);
                result.positions.push_back(mesh.positions[vertex]);
                result.uv_texels.push_back(places[c].texel(charts[c].project(mesh.positions[vertex])));
            }
            result.indices.push_back(copy_of[vertex]);
            result.normals.push_back(normals[3 * std::size_t{t} + k]);
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
        // Upper limit of the atlas's texels; without it the charts would waste memory.
        texel_box_ = std::max(texel_box_, static_cast<float>(std::sqrt(0.5 * surface_box2) / largest_atlas_));
    }
    ChartFinder finder(mesh, static_cast<std::uint32_t>(added_.size()) + 1, texel_box_, stray_box, charts_);
    if (!added_.empty()) {
        finder.take_from(added_.back().mesh, added_.back().chart_of);
    }
    added_.push_back({mesh, finder.find()});
}

std::vector<ChartedMesh> SharedCharts::lay_out() const {
    std::vector<std::vector<glm::vec2>> points(charts_.size());
    for (const Added& added : added_) {
        for (std::size_t k = 0; k < added.mesh.indices.size(); ++k) {
            if (const std::uint32_t c = added.chart_of[k / 3]; c != no_chart) {
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

} // namespace frustumscreen::bake
