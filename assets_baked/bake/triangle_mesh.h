/// Plain triangles in the box frame.
///
/// Frame    box (longest edge 1); counter-clockwise seen from outside.
/// Threads  pure; any.
/// Library  meshoptimizer.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::bake {

struct TriangleMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] std::size_t triangle_count() const { return indices.size() / 3; }
    [[nodiscard]] const glm::vec3& corner(std::size_t triangle, int k) const {
        return positions[indices[3 * triangle + static_cast<std::size_t>(k)]];
    }
    /// Its length is twice the triangle's area.
    [[nodiscard]] glm::vec3 area_normal(std::size_t triangle) const {
        return glm::cross(corner(triangle, 1) - corner(triangle, 0),
                          corner(triangle, 2) - corner(triangle, 0));
    }
};

/// The source's triangles with equal positions shared; degenerate triangles and repetitions (in either
/// orientation, because triangles are two-sided) are dropped.
[[nodiscard]] TriangleMesh weld(const SourceMesh& mesh, std::span<const glm::dvec3> box_points);

/// Errors   no triangle is left.
[[nodiscard]] Result<void> check_surface(const TriangleMesh& welded);

/// Drops triangles with repeated corners, and all but the first of those with the same three corners.
void drop_repetitions(std::vector<std::uint32_t>& indices);
/// Drops vertices that no triangle uses.
void compact(TriangleMesh& mesh);

/// For each position, the mean of its triangles' normals, by area; unit, or +Z if there is none.
[[nodiscard]] std::vector<glm::vec3> smooth_normals(const TriangleMesh& mesh);
/// Normals of each triangle's three corners: the mean, by area, of the normals of the triangles around that position,
/// except those across a hard edge, which is one of more than `hard_edge_deg`. Unit; +Z if there is none.
inline constexpr double hard_edge_deg = 50.0;
[[nodiscard]] std::vector<glm::vec3> corner_normals(const TriangleMesh& mesh);

/// The same triangles as a SourceMesh without materials, for ray casts.
[[nodiscard]] SourceMesh as_source(const TriangleMesh& mesh);

} // namespace frustumscreen::bake
