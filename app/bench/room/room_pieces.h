/// The source meshes of the room that `frustumscreen-bench room` measures: twelve packs' worth, each artifact of as many
/// triangles as asked for.
///
/// Frame    +Y up, millimetres; deterministic.
/// Threads  uses all cores; any.
/// Errors   as make_builtin: a count that no artifact has.
#pragma once

#include "assets_baked/bake/source_mesh.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bench {

enum class PieceUse {
    Artifact,
    Plinth, ///< artifacts stand on it
    Wall,   ///< seen from its +Z side
    Floor,
};

struct RoomPiece {
    std::string name; ///< of its pack's file
    PieceUse use = PieceUse::Artifact;
    bake::SourceMesh mesh;
};

/// Nine artifacts, then a plinth, a wall and a floor. `triangles`: of each artifact, about; at least 1000. The plain pieces
/// have a tenth of it.
[[nodiscard]] Result<std::vector<RoomPiece>> make_room_pieces(std::int64_t triangles);

/// Writes its pack. `size`: as BakeOptions. Errors: as bake and write_file.
[[nodiscard]] Result<void> bake_piece(const RoomPiece& piece, const std::filesystem::path& pack, int size);

} // namespace frustumscreen::bench
