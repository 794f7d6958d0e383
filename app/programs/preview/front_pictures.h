/// Pictures for the preview's page: the artifact in the prop, whose front is towards the visitor, at several times.
///
/// Drawn as the turn's pictures (preview_view.h), half as wide and high.
///
/// Units    seconds since the scene began.
/// Errors   as load_pack; no OpenGL ES.
/// Threads  one: it holds a GL context while it draws.
#pragma once

#include "app/image/image.h"
#include "app/programs/preview/turn_pictures.h"
#include "app/show/offline_scene.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <filesystem>
#include <functional>
#include <span>

namespace frustumscreen::programs {

struct FrontPictures {
    glm::ivec2 size{0};  ///< of one picture
    image::Image8 sheet; ///< side by side, one for each time
};

/// `options`: the turn's; `change` sets what is drawn; `drawn` is called after each picture with the share of all.
[[nodiscard]] Result<FrontPictures> front_pictures(const std::filesystem::path& pack_file,
                                                   const TurnOptions& options,
                                                   const std::function<void(show::OfflineOptions&)>& change,
                                                   std::span<const double> times_s,
                                                   const std::function<void(double)>& drawn);

} // namespace frustumscreen::programs
