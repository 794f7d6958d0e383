/// The game board's pack, which several commands of the bench measure.
///
/// Errors   of baking and writing.
#pragma once

#include "app/programs/bench/bench_command.h"

#include <filesystem>

namespace frustumscreen::programs {

/// Bakes the game board into `folder`, so that its cells have the levels and reliefs of the present bake. `mesh` gets its
/// source.
[[nodiscard]] Result<BenchArtifact> bake_board(const std::filesystem::path& folder, bake::SourceMesh& mesh,
                                               BenchProgress& progress);

} // namespace frustumscreen::programs
