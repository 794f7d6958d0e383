#include "assets_baked/bake/cell_clusters.h"

#include "assets_baked/bake/connected_parts.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <unordered_map>

namespace frustumscreen::bake {

namespace {

/// For each vertex a number that those of its chart share: vertices that triangles connect, by equal positions and
/// texture coordinates. Empty for a mesh without texture coordinates.
std::vector<std::uint32_t> charts_of(const SourceMesh& mesh) {
    std::vector<std::uint32_t> chart;
    if (mesh.uvs.empty()) {
        return chart;
    }
    const std::array<meshopt_Stream, 2> streams{
        {{mesh.positions.data(), sizeof(glm::dvec3), sizeof(glm::dvec3)},
         {mesh.uvs.data(), sizeof(glm::vec2), sizeof(glm::vec2)}}};
    chart.resize(mesh.positions.size());
    const std::size_t count = meshopt_generateVertexRemapMulti(chart.data(), mesh.triangles.front().data(),
                                                               3 * mesh.triangles.size(), chart.size(),
                                                               streams.data(), streams.size());
    const std::vector<std::uint32_t> part = connected_parts(mesh, chart, count);
    for (std::uint32_t& each : chart) {
        each = each < count ? part[each] : each; // no triangle uses this one
    }
    return chart;
}

glm::vec3 unit_or_zero(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0.0F ? v / length : glm::vec3(0.0F);
}

} // namespace

CellClusters::CellClusters(const SourceMesh& mesh, const glm::dvec3& low, double cell)
    : mesh_(mesh), low_(low), cell_(cell), part_of_(mesh.positions.size(), CellNumbers::none) {
    const std::vector<std::uint32_t> charts = charts_of(mesh);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t vertex : mesh.triangles[t]) {
            if (part_of_[vertex] == CellNumbers::none) {
                add_vertex(vertex, charts.empty() ? 0 : charts[vertex]);
            }
        }
        add_triangle(t);
    }
}

glm::dvec3 CellClusters::in_cells(std::uint32_t vertex) const {
    return (mesh_.positions[vertex] - low_) / cell_;
}

void CellClusters::add_vertex(std::uint32_t vertex, std::uint32_t chart) {
    const glm::dvec3 at = in_cells(vertex);
    const glm::i64vec3 cell =
        glm::clamp(glm::i64vec3(at), std::int64_t{0}, max_cells_along - std::int64_t{1});
    const std::uint32_t cluster = cells_.number_of(key_of(cell)).number;
    if (cluster == clusters_.size()) {
        clusters_.emplace_back();
        cell_of_cluster_.emplace_back(cell);
    }
    clusters_[cluster].add_vertex(glm::vec3(at - glm::dvec3(cell) - 0.5));
    const std::uint32_t part = part_numbers_.number_of({cluster, chart}).number;
    if (part == parts_.size()) {
        parts_.push_back({cluster, 0.0F});
        uv_sums_.resize(mesh_.uvs.empty() ? 0 : parts_.size(), glm::vec2(0.0F));
        colour_sums_.resize(mesh_.colours.empty() ? 0 : parts_.size(), glm::vec4(0.0F));
        normal_sums_.resize(mesh_.normals.empty() ? 0 : parts_.size(), glm::vec3(0.0F));
    }
    part_of_[vertex] = part;
    parts_[part].count += 1.0F;
    if (!mesh_.uvs.empty()) {
        uv_sums_[part] += mesh_.uvs[vertex];
    }
    if (!mesh_.colours.empty()) {
        colour_sums_[part] += mesh_.colours[vertex];
    }
    if (!mesh_.normals.empty()) {
        normal_sums_[part] += mesh_.normals[vertex];
    }
}

void CellClusters::add_triangle(std::size_t triangle) {
    const std::array<std::uint32_t, 3>& corners = mesh_.triangles[triangle];
    std::array<glm::dvec3, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) {
        at[k] = in_cells(corners[k]);
    }
    const glm::vec3 normal(0.5 * glm::cross(at[1] - at[0], at[2] - at[0]));
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t cluster = cluster_of(corners[k]);
        const glm::dvec3 middle = glm::dvec3(cell_of_cluster_[cluster]) + 0.5;
        clusters_[cluster].add_plane(normal, glm::vec3(at[k] - middle));
    }
}

bool CellClusters::spans_cells(std::size_t triangle) const {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return cluster_of(a) != cluster_of(b) && cluster_of(b) != cluster_of(c) && cluster_of(c) != cluster_of(a);
}

std::vector<bool> CellClusters::reached() const {
    std::vector<bool> reached(clusters_.size(), false);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        if (spans_cells(t)) {
            for (const std::uint32_t vertex : mesh_.triangles[t]) {
                reached[cluster_of(vertex)] = true;
            }
        }
    }
    return reached;
}

/// The result while it grows.
class CellClusters::Output {
public:
    explicit Output(const CellClusters& from)
        : from_(from), vertex_of_part_(from.parts_.size(), CellNumbers::none) {}

    /// `as_in_the_scan`: with the scan's own vertices.
    void add(std::size_t triangle, bool as_in_the_scan) {
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = from_.mesh_.triangles[triangle][k];
            corners[k] = as_in_the_scan ? copy_of(vertex) : vertex_of(from_.part_of_[vertex]);
        }
        mesh_.triangles.push_back(corners);
        mesh_.triangle_materials.push_back(from_.mesh_.triangle_materials[triangle]);
        if (!from_.mesh_.triangle_nodes.empty()) {
            mesh_.triangle_nodes.push_back(from_.mesh_.triangle_nodes[triangle]);
        }
    }

    [[nodiscard]] SourceMesh take() { return std::move(mesh_); }

private:
    std::uint32_t vertex_of(std::uint32_t part) {
        std::uint32_t& vertex = vertex_of_part_[part];
        if (vertex == CellNumbers::none) {
            vertex = static_cast<std::uint32_t>(mesh_.positions.size());
            const auto& [cluster, count] = from_.parts_[part];
            const glm::dvec3 middle = glm::dvec3(from_.cell_of_cluster_[cluster]) + 0.5;
            mesh_.positions.push_back(from_.low_ +
                                      from_.cell_ * (middle + glm::dvec3(from_.clusters_[cluster].best())));
            if (!from_.uv_sums_.empty()) {
                mesh_.uvs.push_back(from_.uv_sums_[part] / count);
            }
            if (!from_.colour_sums_.empty()) {
                mesh_.colours.push_back(from_.colour_sums_[part] / count);
            }
            if (!from_.normal_sums_.empty()) {
                mesh_.normals.push_back(unit_or_zero(from_.normal_sums_[part]));
            }
        }
        return vertex;
    }

    std::uint32_t copy_of(std::uint32_t vertex) {
        const SourceMesh& scan = from_.mesh_;
        const auto [known, is_new] =
            copies_.try_emplace(vertex, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (is_new) {
            mesh_.positions.push_back(scan.positions[vertex]);
            if (!scan.uvs.empty()) {
                mesh_.uvs.push_back(scan.uvs[vertex]);
            }
            if (!scan.colours.empty()) {
                mesh_.colours.push_back(scan.colours[vertex]);
            }
            if (!scan.normals.empty()) {
                mesh_.normals.push_back(scan.normals[vertex]);
            }
        }
        return known->second;
    }

    const CellClusters& from_;
    SourceMesh mesh_;
    std::vector<std::uint32_t> vertex_of_part_;
    std::unordered_map<std::uint32_t, std::uint32_t> copies_; ///< by the scan's vertices
};

SourceMesh CellClusters::reduced() const {
    const std::vector<bool> is_reached = reached();
    Output output(*this);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        const std::array<std::uint32_t, 3>& corners = mesh_.triangles[t];
        const bool spans = spans_cells(t);
        if (spans || std::any_of(corners.begin(), corners.end(),
                                 [&](std::uint32_t vertex) { return !is_reached[cluster_of(vertex)]; })) {
            output.add(t, !spans);
        }
    }
    return output.take();
}

} // namespace frustumscreen::bake
