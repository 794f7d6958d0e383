/// Looks for coordinates that are too coarse for their mesh's size (last_look.h): each is a sentence that says what and what
/// to do, or nothing.
///
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <optional>
#include <string>

namespace frustumscreen::bake {

/// Numbers of 32 bits, far from the origin.
[[nodiscard]] std::optional<std::string> look_for_far_origin(const SourceMesh& mesh);
/// Numbers with few decimals, on a surface whose triangles are about as small as the last one. Triangles along the axes,
/// as of bodies that are made of blocks, do not count.
[[nodiscard]] std::optional<std::string> look_for_few_decimals(const SourceMesh& mesh);

} // namespace frustumscreen::bake
