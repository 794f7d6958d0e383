/// The objects of the example hall (config/hall/room.toml) beside the two built-in artifacts.
///
/// An exhibit's artifacts have texts in every language (builtin.h); these have a name alone, since a room is looked at.
/// Frame, threads   as builtin.h.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace frustumscreen::artifacts {

enum class HallKind {
    Artifact,
    Building, ///< its colours have their light: bake it with --unlit
};
enum class HallSurface {
    Closed,
    Open, ///< at its back, or where a part ends within another
};

struct HallObject {
    std::string_view name;
    std::string_view what; ///< a few English words
    HallKind kind = HallKind::Artifact;
    HallSurface surface = HallSurface::Closed;
    bake::SourceMesh (*make)(std::int64_t triangles) = nullptr;
};

[[nodiscard]] std::span<const HallObject> hall_objects();

} // namespace frustumscreen::artifacts
