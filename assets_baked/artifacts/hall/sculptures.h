/// Sculptures, tools and a shell of the example hall.
///
/// Frame, threads   as builtin.h.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>

namespace frustumscreen::artifacts {

/// A fluted drum of a marble column, with the hole of its dowel.
[[nodiscard]] bake::SourceMesh make_column_drum(std::int64_t triangles);
/// A model of a pyramid of nine steps with a stair on each side and a temple on top.
[[nodiscard]] bake::SourceMesh make_step_pyramid(std::int64_t triangles);
/// A clay tablet with lines of wedges.
[[nodiscard]] bake::SourceMesh make_tablet(std::int64_t triangles);
/// A standing figure with folded arms, after those of the Cyclades.
[[nodiscard]] bake::SourceMesh make_figurine(std::int64_t triangles);
/// A bronze helmet with cheek pieces, nose guard and a crest of red horsehair.
[[nodiscard]] bake::SourceMesh make_helmet(std::int64_t triangles);
/// A sea snail's shell.
[[nodiscard]] bake::SourceMesh make_shell(std::int64_t triangles);

} // namespace frustumscreen::artifacts
