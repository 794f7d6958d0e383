/// Plain triangles in the box frame, and their simplification.
///
/// Frame    box (longest edge 1); counter-clockwise seen from outside.
/// Threads  pure; any.
/// Library  meshoptimizer (Garland & Heckbert 1997 quadrics).
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen {

struct TriangleMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    [[nodiscard]] std::size_t triangle_count() const { return indices.size() / 3; }
    [[nodiscard]] const glm::vec3& corner(std::size_t triangle, int k) const {
        return positions[indices[3 * triangle + static_cast<std::size_t>(k)]];
    }
    /// Its length is twice the area.
    [[nodiscard]] glm::vec3 area_normal(std::size_t triangle) const {
        return glm::cross(corner(triangle, 1) - corner(triangle, 0),
                          corner(triangle, 2) - corner(triangle, 0));
    }
};

/// The source's triangles with equal positions shared; degenerate triangles and repetitions (in either
/// orientation: triangles are two-sided) are dropped.
[[nodiscard]] TriangleMesh weld(const SourceMesh& mesh, std::span<const glm::dvec3> box_points);

/// The fewest triangles that meshoptimizer reaches within `tolerance_box`, cell by cell, run until nothing
/// changes. Its errors are 32-bit and see nothing below about 3e-4 of the mesh's extent: in cells of 0.15 box
/// the surface strays 20 to 40 % less at the same number of triangles, where a mesh is dense enough. A single
/// run stops early on dense meshes (a source of 4M triangles kept 2.3 times as many as one of 100k). Several
/// runs add up to a little more than the tolerance; every level is measured afterwards.
[[nodiscard]] TriangleMesh simplify(const TriangleMesh& mesh, float tolerance_box);

/// The same triangles as a SourceMesh without materials, for ray casts.
[[nodiscard]] SourceMesh as_source(const TriangleMesh& mesh);

} // namespace frustumscreen
