/// Pictures for the preview's page: the artifact in each of its states, as a window on the table shows it.
///
/// Drawn by front_pictures.h.
///
/// Errors   as states_of and load_pack; no OpenGL ES.
/// Threads  one: it holds a GL context while it draws.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack.h"
#include "app/pack/pack_states.h"
#include "app/programs/preview/turn_pictures.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <vector>

namespace frustumscreen::programs {

struct StatePicture {
    pack::PackState state;
    image::Image8 picture;
};

/// One for each state; empty for a pack without. `options`: the turn's; the pictures are half as wide and high.
[[nodiscard]] Result<std::vector<StatePicture>> state_pictures(const std::filesystem::path& pack_file,
                                                               const pack::PackDescription& pack,
                                                               const TurnOptions& options = {});

} // namespace frustumscreen::programs
