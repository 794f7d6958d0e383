#include "assets_baked/bake/simplify.h"

#include "assets_baked/bake/source_scene.h"
#include "firmware_host/base/parallel.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <span>
#include <utility>

namespace frustumscreen::bake {

namespace {

std::vector<std::uint32_t> simplified(const std::vector<std::uint32_t>& indices,
                                      const std::vector<glm::vec3>& positions, float tolerance_box,
                                      unsigned options) {
    std::vector<std::uint32_t> result(indices.size());
    const float scale = meshopt_simplifyScale(&positions[0].x, positions.size(), sizeof(glm::vec3));
    result.resize(meshopt_simplify(result.data(), indices.data(), indices.size(), &positions[0].x,
                                   positions.size(), sizeof(glm::vec3), 0,
                                   tolerance_box / std::max(scale, 1e-20F), options, nullptr));
    return result;
}

/// Each triangle with the grid cell of its centre, sorted by cell.
std::vector<std::pair<std::uint64_t, std::uint32_t>> by_cell(const TriangleMesh& mesh, float offset_box) {
    constexpr float cell_box = 0.15F;
    constexpr float low = -2.0F; // below every box
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    order.reserve(mesh.triangle_count());
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const glm::vec3 centre = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0F;
        const glm::u64vec3 cell(glm::max((centre - low + offset_box) / cell_box, glm::vec3(0.0F)));
        order.emplace_back(cell.x << 42U | cell.y << 21U | cell.z, t);
    }
    std::sort(order.begin(), order.end());
    return order;
}

/// Simplifies each cell in its own coordinates and keeps the vertices that cells share.
TriangleMesh simplify_in_cells(const TriangleMesh& mesh, float tolerance_box, float offset_box) {
    constexpr std::uint32_t unknown = 0xFFFFFFFFU;
    const auto order = by_cell(mesh, offset_box);
    TriangleMesh result{mesh.positions, {}};
    result.indices.reserve(mesh.indices.size());
    std::vector<std::uint32_t> local_of(mesh.positions.size(), unknown);
    for (std::size_t begin = 0; begin < order.size();) {
        std::vector<std::uint32_t> vertices;
        std::vector<std::uint32_t> indices;
        std::vector<glm::vec3> positions;
        std::size_t end = begin;
        for (; end < order.size() && order[end].first == order[begin].first; ++end) {
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t vertex = mesh.indices[3 * std::size_t{order[end].second} + c];
                if (local_of[vertex] == unknown) {
                    local_of[vertex] = static_cast<std::uint32_t>(vertices.size());
                    vertices.push_back(vertex);
                    positions.push_back(mesh.positions[vertex] - mesh.positions[vertices[0]]);
                }
                indices.push_back(local_of[vertex]);
            }
        }
        for (const std::uint32_t local :
             simplified(indices, positions, tolerance_box, meshopt_SimplifyLockBorder)) {
            result.indices.push_back(vertices[local]);
        }
        for (const std::uint32_t vertex : vertices) {
            local_of[vertex] = unknown;
        }
        begin = end;
    }
    return result;
}

TriangleMesh simplified_by_area(const TriangleMesh& mesh, float tolerance_box, unsigned borders) {
    constexpr std::size_t dense = 50'000; // below this, cells would contain little but border triangles
    TriangleMesh result = mesh;
    std::size_t before = 0;
    do {
        before = result.triangle_count();
        if (mesh.triangle_count() >= dense) {
            for (const float offset_box :
                 {0.0F, 0.075F}) { // a border of one grid is inside a cell of the other
                result = simplify_in_cells(result, tolerance_box, offset_box);
            }
        } else if (before > 0) {
            result.indices = simplified(result.indices, result.positions, tolerance_box, borders);
            drop_repetitions(result.indices);
        }
    } while (20 * result.triangle_count() < 19 * before);
    if (!result.indices.empty() && mesh.triangle_count() >= dense) { // open borders, which cells never change
        result.indices = simplified(result.indices, result.positions, tolerance_box, borders);
    }
    drop_repetitions(result.indices);
    compact(result);
    return result;
}

/// Distance of each used vertex from the surface, limited to `reach_box`.
std::vector<float> distances_to(const TriangleMesh& surface, const TriangleMesh& mesh, float reach_box) {
    const SourceMesh source = as_source(surface);
    const std::vector<glm::dvec3> points(surface.positions.begin(), surface.positions.end());
    const SourceScene scene(source, points);
    std::vector<float> distances(mesh.positions.size());
    parallel_for(distances.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const SurfaceHit hit = scene.nearest(mesh.positions[k], reach_box);
            distances[k] = hit.hit ? hit.distance : reach_box;
        }
    });
    return distances;
}

/// The triangles around corners that `fewer` has lost, and their surroundings as far as it strays. `mesh` has
/// no unused vertex.
TriangleMesh lost_part(const TriangleMesh& mesh, const TriangleMesh& fewer, float tolerance_box) {
    const float strays_box = 2.0F * tolerance_box;
    const float lost_box = max_tolerances_lost * tolerance_box;
    const std::vector<float> distances = distances_to(fewer, mesh, lost_box);
    std::vector<bool> lost(distances.size());
    std::size_t count = 0;
    for (std::size_t k = 0; k < distances.size(); ++k) {
        lost[k] = distances[k] >= lost_box;
        count += lost[k] ? 1 : 0;
    }
    for (std::size_t before = 0; before != count;) { // spreads over adjacent corners that stray
        before = count;
        for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
            const auto corners = std::span(mesh.indices).subspan(t, 3);
            if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return lost[v]; })) {
                for (const std::uint32_t v : corners) {
                    const bool more = !lost[v] && distances[v] > strays_box;
                    lost[v] = lost[v] || more;
                    count += more ? 1 : 0;
                }
            }
        }
    }
    TriangleMesh part{mesh.positions, {}};
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto corners = std::span(mesh.indices).subspan(t, 3);
        if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return lost[v]; })) {
            part.indices.insert(part.indices.end(), corners.begin(), corners.end());
        }
    }
    compact(part);
    return part;
}

void append(TriangleMesh& mesh, const TriangleMesh& more) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
    for (const std::uint32_t index : more.indices) {
        mesh.indices.push_back(first + index);
    }
}

} // namespace

TriangleMesh simplify(const TriangleMesh& mesh, float tolerance_box, Borders borders) {
    constexpr float finest_tolerance_box = 2e-5F; // below this, the library's errors are meaningless
    if (mesh.indices.empty() || tolerance_box < finest_tolerance_box) {
        return mesh;
    }
    TriangleMesh result =
        simplified_by_area(mesh, tolerance_box,
                           borders == Borders::Stay ? static_cast<unsigned>(meshopt_SimplifyLockBorder) : 0U);
    const TriangleMesh lost = result.indices.empty() ? mesh : lost_part(mesh, result, tolerance_box);
    append(result, simplify(lost, tolerance_box / 3.0F, borders));
    return result;
}

} // namespace frustumscreen::bake
