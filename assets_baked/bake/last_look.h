/// Looks for likely mistakes in a mesh that was read without an error, and suggests a remedy for each.
///
/// Scraps   connected parts of few triangles far from the rest, as photogrammetry leaves them; they make the artifact
///          small in its prop.
/// Sides    triangles that are turned inside out beside others that are not (winding.h).
/// Light    colours that are all black; colours with light in them, lit a second time.
/// Colours  a picture or colours at the vertices, of one colour.
/// Steps    coordinates so large, or with so few decimals, that their rounding is visible.
/// Shape    parts are connected by equal positions.
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>
#include <vector>

namespace frustumscreen::bake {

struct Scraps {
    std::vector<bool> is_scrap; ///< one for each triangle; empty: no scraps
    std::size_t triangles = 0;
    double size_with = 0.0; ///< longest edge of the bounding box, file units
    double size_without = 0.0;
};

[[nodiscard]] Scraps find_scraps(const SourceMesh& mesh);
void remove_scraps(SourceMesh& mesh, const Scraps& scraps);

/// The light that a bake puts on the colours.
enum class Lighting : std::uint8_t { None, Museum };

/// Notes on scraps that are kept, and on everything else.
[[nodiscard]] std::vector<SourceNote> last_look(const SourceMesh& mesh, const Scraps& scraps,
                                                Lighting lighting);

} // namespace frustumscreen::bake
