/// Pictures for the preview's page: what a visitor sees while a behaviour plays, in equal steps of its time.
///
/// Drawn by front_pictures.h.
///
/// Units    seconds since the behaviour began.
/// Errors   as load_world and load_pack; no OpenGL ES.
/// Threads  one: it holds a GL context while it draws.
#pragma once

#include "app/image/image.h"
#include "app/pack/pack_world.h"
#include "app/programs/preview/turn_pictures.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <vector>

namespace frustumscreen::programs {

struct BehaviourPictures {
    pack::PackBehaviour behaviour;
    int frames = 1;
    double step_s = 0.0; ///< from one picture to the next; the first shows the beginning, the last the end
    glm::ivec2 size{0};  ///< of one picture
    image::Image8 sheet; ///< side by side
};

/// One for each behaviour; empty for a pack without. `options`: the turn's; the pictures are half as wide and high.
[[nodiscard]] Result<std::vector<BehaviourPictures>>
behaviour_pictures(const std::filesystem::path& pack_file, const TurnOptions& options = {});

} // namespace frustumscreen::programs
