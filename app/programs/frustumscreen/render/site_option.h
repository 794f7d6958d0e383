/// The part of a site that `frustumscreen render --site` draws large.
///
/// Frames   box, as pack.h: the site's longer side is 1, its middle at 0, 0.
/// Threads  pure; any.
/// Errors   a text that is no such part.
#pragma once

#include "app/programs/common/command_line.h"
#include "app/show/offline_scene.h"

#include <string>

namespace frustumscreen::programs {

/// "X,Y,ZOOM".
[[nodiscard]] ArgumentCheck is_site();

/// `text` passed the check.
[[nodiscard]] show::OfflineSite site_in(const std::string& text);

} // namespace frustumscreen::programs
