/// Looks for likely mistakes in a mesh that was read without an error, and suggests a remedy for each.
///
/// Scraps   connected parts of few triangles far from the rest, as photogrammetry leaves them; they make the artifact
///          small in its prop.
/// Light    colours that are all black.
/// Steps    coordinates so large that their 32-bit rounding is visible.
/// Shape    parts are connected by equal positions.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>
#include <vector>

namespace frustumscreen {

struct Scraps {
    std::vector<bool> is_scrap; ///< one for each triangle; empty: no scraps
    std::size_t triangles = 0;
    double size_with = 0.0; ///< longest edge of the bounding box, file units
    double size_without = 0.0;
};

[[nodiscard]] Scraps find_scraps(const SourceMesh& mesh);
void remove_scraps(SourceMesh& mesh, const Scraps& scraps);

/// Notes on scraps that are kept, on light and on steps.
[[nodiscard]] std::vector<SourceNote> last_look(const SourceMesh& mesh, const Scraps& scraps);

} // namespace frustumscreen
