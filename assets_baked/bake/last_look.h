/// What looks wrong with a mesh that was read without a fault, said as a guess, with what to do.
///
/// Scraps   connected parts of few triangles far from the rest, which make the artifact small in its prop: what photogrammetry leaves behind.
/// Light    colours that are all black.
/// Steps    coordinates so large that 32-bit numbers put points on a grid that shows.
/// Shape    parts are connected by equal positions.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>
#include <vector>

namespace frustumscreen {

struct Scraps {
    std::vector<bool> is_scrap; ///< one each triangle; empty: there are none
    std::size_t triangles = 0;
    double size_with = 0.0; ///< longest edge of the bounding box, file units
    double size_without = 0.0;
};

[[nodiscard]] Scraps find_scraps(const SourceMesh& mesh);
void remove_scraps(SourceMesh& mesh, const Scraps& scraps);

/// Notes of scraps that stay, of light and of steps.
[[nodiscard]] std::vector<SourceNote> last_look(const SourceMesh& mesh, const Scraps& scraps);

} // namespace frustumscreen
