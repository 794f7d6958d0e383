/// The tables [[torch]] of artifact.toml: what a visitor's torch throws onto the artifact.
///
/// Units    shares of the content's width; degrees and shares a second; colours in linear light.
/// Errors   in the table's ReadState.
/// Threads  one caller.
#pragma once

#include "app/pack/pack.h"
#include "app/settings/table_reader.h"
#include "app/torch/content.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::folder {

struct ArtifactTorchStage {
    std::string place;             ///< file, line and key of what it shows, for messages
    torch::Stage look;             ///< its `item` is not known yet
    std::filesystem::path file;    ///< of a picture, film or layer; a path including the folder
    std::optional<double> rate_hz; ///< of a film; nothing: its own, or 25
    bool lit = true;               ///< a layer is lit as the artifact is
};

struct ArtifactTorch {
    std::string place; ///< file, line and key, for messages
    std::string name;
    torch::Blend blend = torch::Blend::Light;
    std::optional<torch::Shape> shape;      ///< nothing: the torch's own, or a picture's rectangle
    std::optional<double> height_per_width; ///< nothing: of its picture or film, or 1
    std::vector<ArtifactTorchStage> stages; ///< 1 to torch::max_stages
    std::vector<pack::PackLabel> titles;    ///< what the visitor is told, in each language
};

/// A stage that shows the layer `key` of another table; the key is there.
void read_layer(settings::TableReader& table, ArtifactTorchStage& stage);

/// `before`: the contents above this one.
void read_torch(settings::TableReader& table, ArtifactTorch& content,
                const std::vector<ArtifactTorch>& before);

} // namespace frustumscreen::folder
