#include "assets_baked/bake/reduce_scan.h"

#include "assets_baked/bake/cell_clusters.h"
#include "assets_baked/bake/coordinate_looks.h"
#include "assets_baked/bake/sampled_distances.h"
#include "assets_baked/bake/winding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace frustumscreen::bake {

namespace {

/// Bounds and area of the vertices that triangles use.
struct Extent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    double area = 0.0;

    [[nodiscard]] double longest() const {
        const glm::dvec3 edges = high - low;
        return std::max({edges.x, edges.y, edges.z});
    }
};

Extent extent_of(const SourceMesh& mesh) {
    Extent extent;
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3& p = mesh.positions[a];
        const glm::dvec3& q = mesh.positions[b];
        const glm::dvec3& r = mesh.positions[c];
        extent.low = glm::min(extent.low, glm::min(p, glm::min(q, r)));
        extent.high = glm::max(extent.high, glm::max(p, glm::max(q, r)));
        extent.area += 0.5 * glm::length(glm::cross(q - p, r - p));
    }
    return extent;
}

/// A plane of area A meets about 1.5 A / edge^2 cells, by its slope, and a surface has two triangles for each vertex.
double cell_for(const Extent& extent, std::size_t triangles) {
    constexpr double triangles_a_square = 3.0;
    const double edge = std::sqrt(triangles_a_square * extent.area / static_cast<double>(triangles));
    return std::max(edge, 2.0 * extent.longest() / static_cast<double>(max_cells_along));
}

/// Different points that triangles use.
std::size_t count_points(const SourceMesh& mesh) {
    const std::vector<std::uint32_t> numbers = numbers_of_places(mesh);
    std::vector<bool> used(numbers.size(), false);
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            used[numbers[vertex]] = true;
        }
    }
    return static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
}

SurfaceView view_of(const SourceMesh& mesh) {
    return {mesh.positions, mesh.triangles};
}

/// Corners of triangles evenly taken from the list, because thin parts have hardly any area.
std::vector<glm::dvec3> some_corners(const SourceMesh& mesh, std::size_t count) {
    std::vector<glm::dvec3> corners;
    const std::size_t step = 1 + mesh.triangles.size() / count;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += step) {
        corners.push_back(mesh.positions[mesh.triangles[t][0]]);
    }
    return corners;
}

/// Fills in the distances between both surfaces.
void measure(SourceReduction& reduction, const SourceMesh& scan, const SourceMesh& reduced, double cell,
             std::size_t samples) {
    const double usual = 0.5 * cell;
    std::vector<double> distances = distances_to(view_of(reduced), points_on(view_of(scan), samples), usual);
    const std::vector<double> back = distances_to(view_of(scan), points_on(view_of(reduced), samples), usual);
    const std::vector<double> corners = distances_to(view_of(reduced), some_corners(scan, samples), usual);
    distances.insert(distances.end(), back.begin(), back.end());
    if (distances.empty()) {
        return;
    }
    std::sort(distances.begin(), distances.end());
    reduction.mean =
        std::accumulate(distances.begin(), distances.end(), 0.0) / static_cast<double>(distances.size());
    reduction.p95 = distances[distances.size() * 95 / 100];
    reduction.max = std::accumulate(corners.begin(), corners.end(), distances.back(),
                                    [](double a, double b) { return std::max(a, b); });
}

SourceNote note_of(const SourceReduction& reduction, std::size_t left, double size) {
    return {SourceNote::Kind::Guessed,
            fmt::format(
                "its {} triangles are more than a bake uses: it is baked from {}, which lie {:.2g} of its "
                "size from the scan's surface on average, {:.2g} at most; the errors of the levels contain "
                "this",
                reduction.triangles, left, reduction.mean / size, reduction.max / size)};
}

} // namespace

void reduce_scan(SourceMesh& mesh, const ReduceLimits& limits) {
    if (mesh.triangles.size() <= limits.most) {
        return;
    }
    const Extent extent = extent_of(mesh);
    if (!(extent.area > 0.0)) {
        return;
    }
    for (const std::optional<std::string>& look : {look_for_far_origin(mesh), look_for_few_decimals(mesh)}) {
        if (look) { // not to be seen in the reduced scan
            mesh.notes.push_back({SourceNote::Kind::Guessed, *look});
        }
    }
    const double cell = cell_for(extent, limits.wanted);
    SourceMesh reduced = CellClusters(mesh, extent.low, cell).reduced();
    if (reduced.triangles.empty()) {
        return;
    }
    SourceReduction reduction{.triangles = mesh.triangles.size(),
                              .points = count_points(mesh),
                              .mean = 0.0,
                              .p95 = 0.0,
                              .max = 0.0};
    measure(reduction, mesh, reduced, cell, limits.samples);
    mesh.positions = std::move(reduced.positions);
    mesh.uvs = std::move(reduced.uvs);
    mesh.colours = std::move(reduced.colours);
    mesh.normals = std::move(reduced.normals);
    mesh.triangles = std::move(reduced.triangles);
    mesh.triangle_materials = std::move(reduced.triangle_materials);
    mesh.triangle_nodes = std::move(reduced.triangle_nodes);
    mesh.notes.push_back(note_of(reduction, mesh.triangles.size(), extent.longest()));
    mesh.reduced_from = reduction;
}

} // namespace frustumscreen::bake
