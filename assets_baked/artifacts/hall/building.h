/// The example hall's own plain geometry. Its textures hold their light: it is baked with --unlit.
///
/// Frame    as builtin.h: millimetres, +Y up, the front towards +Z. Floor, wall and ceiling are sheets: their backs are
///          open and are never seen.
/// Threads  as builtin.h.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>

namespace frustumscreen::artifacts {

/// 3600 wide, 3950 deep, 20 thick: chequered marble in a dark border.
[[nodiscard]] bake::SourceMesh make_hall_floor(std::int64_t triangles);
/// 3600 long, 1300 high: a base, four panels between pilasters, a cornice.
[[nodiscard]] bake::SourceMesh make_hall_wall(std::int64_t triangles);
/// 3600 wide, 3600 deep: coffers around a skylight; seen from below.
[[nodiscard]] bake::SourceMesh make_hall_ceiling(std::int64_t triangles);
/// 300 wide, 340 high: a square plinth on a slab that has its shadow.
[[nodiscard]] bake::SourceMesh make_hall_plinth(std::int64_t triangles);
/// 160 wide, 420 high: a round pedestal.
[[nodiscard]] bake::SourceMesh make_hall_pedestal(std::int64_t triangles);

} // namespace frustumscreen::artifacts
