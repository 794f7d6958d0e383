/// The tables [[states]] of artifact.toml: the same artifact before, after, reconstructed, for windows side by side.
///
/// Errors   in the table's ReadState.
/// Threads  one caller.
#pragma once

#include "app/pack/pack.h"
#include "app/settings/table_reader.h"
#include "assets_baked/folder/artifact_torches.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::folder {

struct ArtifactState {
    std::string place; ///< file, line and key, for messages
    std::string name;
    std::vector<std::string> hide; ///< names of parts of the model that are not there, with all below them
    std::string behaviour;         ///< at whose end it is; empty: at rest
    std::optional<ArtifactTorchStage> layer; ///< the look of the surface; none: its own
    std::vector<pack::PackLabel> titles;     ///< at least one
};

/// `before`: the states above this one.
void read_state(settings::TableReader& table, ArtifactState& state, const std::vector<ArtifactState>& before);

} // namespace frustumscreen::folder
