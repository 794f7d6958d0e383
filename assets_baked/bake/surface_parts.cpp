#include "assets_baked/bake/surface_parts.h"

#include "assets_baked/bake/connected_parts.h"
#include "assets_baked/bake/winding.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace frustumscreen::bake {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

struct Part {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    double area = 0.0;

    [[nodiscard]] double diagonal() const { return glm::length(high - low); }
};

/// The numbers of `roots` that are used, from 0 on, in the order in which they occur.
SurfaceParts numbered(std::span<const std::uint32_t> roots, std::size_t below) {
    SurfaceParts parts;
    std::vector<std::uint32_t> number(below, none);
    for (const std::uint32_t root : roots) {
        if (number[root] == none) {
            number[root] = static_cast<std::uint32_t>(parts.count++);
        }
        parts.part_of.push_back(number[root]);
    }
    return parts;
}

/// Surfaces of one node joined, and nodes of one surface.
SurfaceParts joined_by_nodes(const SourceMesh& mesh, const SurfaceParts& surfaces) {
    if (mesh.nodes.empty()) {
        return surfaces;
    }
    const std::size_t all = surfaces.count + mesh.nodes.size();
    geometry::UnionFind joined(all);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        joined.join(surfaces.part_of[t], static_cast<std::uint32_t>(surfaces.count) + mesh.triangle_nodes[t]);
    }
    std::vector<std::uint32_t> roots;
    for (const std::uint32_t surface : surfaces.part_of) {
        roots.push_back(joined.root(surface));
    }
    return numbered(roots, all);
}

std::vector<Part> measured(const SourceMesh& mesh, const SurfaceParts& parts) {
    std::vector<Part> made(parts.count);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Part& part = made[parts.part_of[t]];
        const auto& [a, b, c] = mesh.triangles[t];
        const glm::dvec3& from = mesh.positions[a];
        part.area += 0.5 * glm::length(glm::cross(mesh.positions[b] - from, mesh.positions[c] - from));
        for (const std::uint32_t vertex : mesh.triangles[t]) {
            part.low = glm::min(part.low, mesh.positions[vertex]);
            part.high = glm::max(part.high, mesh.positions[vertex]);
        }
    }
    return made;
}

double gap(const Part& a, const Part& b) {
    return glm::length(glm::max(glm::max(a.low - b.high, b.low - a.high), glm::dvec3(0.0)));
}

std::uint32_t nearest_of(const std::vector<std::uint32_t>& large, const std::vector<Part>& parts,
                         const Part& small) {
    return *std::min_element(large.begin(), large.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(gap(small, parts[a]), parts[a].diagonal()) <
               std::pair(gap(small, parts[b]), parts[b].diagonal());
    });
}

/// For each triangle, whether an eye of the zone sees one of its sides.
std::vector<bool> seen_triangles(const SourceMesh& mesh, const BoxFrame& frame, const ViewingZone& zone) {
    const std::vector<glm::dvec3> points = in_box(mesh, frame);
    const std::vector<std::uint32_t> places = numbers_of_places(mesh);
    TriangleMesh surface;
    for (std::size_t vertex = 0; vertex < points.size(); ++vertex) {
        surface.positions.resize(std::max<std::size_t>(surface.positions.size(), places[vertex] + 1));
        surface.positions[places[vertex]] = glm::vec3(points[vertex]);
    }
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            surface.indices.push_back(places[vertex]);
        }
    }
    return visible_triangles(surface, SourceScene(mesh, points), zone);
}

} // namespace

SurfaceParts connected_surfaces(const SourceMesh& mesh) {
    const std::vector<std::uint32_t> places = numbers_of_places(mesh);
    const std::vector<std::uint32_t> connected = connected_parts(mesh, places, mesh.positions.size());
    std::vector<std::uint32_t> roots;
    roots.reserve(mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        roots.push_back(connected[places[triangle[0]]]);
    }
    return numbered(roots, mesh.positions.size());
}

SurfaceParts find_parts(const SourceMesh& mesh, double min_share, std::size_t max_parts) {
    SurfaceParts found = joined_by_nodes(mesh, connected_surfaces(mesh));
    const std::vector<Part> parts = measured(mesh, found);
    double area = 0.0;
    for (const Part& part : parts) {
        area += part.area;
    }
    std::vector<std::uint32_t> order(found.count);
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return parts[a].area > parts[b].area; });
    std::vector<std::uint32_t> large;
    for (const std::uint32_t part : order) {
        if (large.empty() || (large.size() < max_parts && parts[part].area >= min_share * area)) {
            large.push_back(part);
        }
    }
    std::vector<std::uint32_t> root(found.count);
    for (const std::uint32_t part : order) {
        const bool is_large = std::find(large.begin(), large.end(), part) != large.end();
        root[part] = is_large ? part : nearest_of(large, parts, parts[part]);
    }
    for (std::uint32_t& part : found.part_of) {
        part = root[part];
    }
    return numbered(found.part_of, root.size());
}

SourceMesh with_parts(SourceMesh mesh, const SurfaceParts& parts, const BoxFrame& frame,
                      const ViewingZone& zone) {
    mesh.nodes.clear();
    mesh.animations.clear();
    mesh.triangle_nodes = parts.part_of;
    for (std::size_t part = 0; part < parts.count; ++part) {
        mesh.nodes.push_back({.name = fmt::format("part {}", part + 1),
                              .parent = std::nullopt,
                              .parent_from_base = glm::dmat4(1.0),
                              .rest = {}});
    }
    const std::vector<bool> seen = seen_triangles(mesh, frame, zone);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (seen[t]) {
            mesh.triangles[kept] = mesh.triangles[t];
            mesh.triangle_materials[kept] = mesh.triangle_materials[t];
            mesh.triangle_nodes[kept] = mesh.triangle_nodes[t];
            ++kept;
        }
    }
    mesh.triangles.resize(kept);
    mesh.triangle_materials.resize(kept);
    mesh.triangle_nodes.resize(kept);
    return mesh;
}

} // namespace frustumscreen::bake
