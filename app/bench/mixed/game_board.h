/// A game board with fourteen turned pieces, each a node: an artifact of many parts, made for `frustumscreen-bench mixed`.
///
/// Frame    +Y up, millimetres; deterministic.
/// Threads  uses all cores; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cstdint>
#include <string_view>

namespace frustumscreen::bench {

inline constexpr std::size_t game_board_pieces = 14;

/// About `triangles` triangles, but at least 1000 for each piece and for the board.
[[nodiscard]] bake::SourceMesh make_game_board(std::int64_t triangles);

enum class GamePiece { Pawn, Rook, Bishop, King };
[[nodiscard]] std::string_view name_of(GamePiece piece);
/// One piece of light stone, standing at the origin; about `triangles` triangles, but at least 1000.
[[nodiscard]] bake::SourceMesh make_game_piece(GamePiece piece, std::int64_t triangles);

} // namespace frustumscreen::bench
