/// Sources with known geometry.
///
/// Frame    the file's own, +Z up.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

namespace frustumscreen::bench {

/// A sphere of rows x 2 rows quads around `centre`; facing outward, welded at the poles.
[[nodiscard]] bake::SourceMesh sphere(const glm::dvec3& centre, double radius, int rows);
[[nodiscard]] bake::SourceMesh box_mesh(const glm::dvec3& size);
void add_triangle(bake::SourceMesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

} // namespace frustumscreen::bench
