/// Pictures for the preview's page: the artifact as a torch shows it that lights all of it, beside the artifact as it is.
///
/// Drawn    layers, in place of the artifact's texture, with the content's blend and opacity. Pictures, films and effects
///          lie where the torch points: the page lays them over the artifact, about as bright.
/// Errors   as turn_pictures and load_layer_texture.
/// Threads  one: it holds a GL context while it draws.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack.h"
#include "app/pack/pack_torches.h"
#include "app/programs/preview/turn_pictures.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct TorchPictures {
    pack::PackTorchContent content;
    std::string shows;     ///< in words
    int frames = 0;        ///< of a sheet, side by side
    glm::ivec2 size{0};    ///< of one picture
    image::Image8 plain;   ///< sheet without the torch; of the first content, for all
    image::Image8 lit;     ///< sheet in the torch's light; empty: no layer
    image::Image8 picture; ///< or a film's first frame; empty: none
};

/// One for each content. `pack`: that of the file, read whole. `options`: the turn's; these pictures are smaller.
[[nodiscard]] Result<std::vector<TorchPictures>> torch_pictures(const std::filesystem::path& pack_file,
                                                                const pack::Pack& pack,
                                                                const TurnOptions& options = {});

/// The texture of a pack under a layer: what the renderer shows where the torch's intensity is full.
[[nodiscard]] image::Image8 with_layer(const image::Image8& texture, const image::Image8& layer,
                                       const torch::Stage& stage, torch::Blend blend);

} // namespace frustumscreen::programs
