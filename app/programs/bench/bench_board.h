/// The game board's pack, which several commands of the bench measure.
///
/// Errors   of baking and writing.
#pragma once

#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <filesystem>
#include <memory>

namespace frustumscreen::programs {

/// The options --pack and --mesh, in place of the game board.
void add_board_options(CommandLine& command, BenchArtifact& artifact);
/// Errors: only one of both options was given.
[[nodiscard]] Result<void> check_board_options(const BenchArtifact& artifact);
/// The source of the given artifact, or of the game board, which is baked into `folder` and named in `artifact`.
[[nodiscard]] Result<std::shared_ptr<const bake::SourceMesh>>
given_or_board(const std::filesystem::path& folder, BenchArtifact& artifact, BenchProgress& progress);

/// Bakes the game board into `folder`, so that its cells have the levels and reliefs of the present bake. `mesh` gets its
/// source.
[[nodiscard]] Result<BenchArtifact> bake_board(const std::filesystem::path& folder, bake::SourceMesh& mesh,
                                               BenchProgress& progress);

} // namespace frustumscreen::programs
