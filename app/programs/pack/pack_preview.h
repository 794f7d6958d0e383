/// A pack's artifact from four sides in one picture, as it stands in a prop of usual size.
///
/// The exhibit's own renderer draws it, at the finest level. The projector stands at the eye, so its picture is the
/// eye's view through the prop, and no visible face is unlit. All sides have one scale, as large as they fit.
///
/// Errors   as load_pack; no OpenGL ES; no typeface.
/// Threads  one: it holds a GL context while it draws.
#pragma once

#include "app/image/image.h"
#include "firmware_host/base/result.h"

#include <filesystem>

namespace frustumscreen::programs {

/// Front, right, back and left, from left to right.
[[nodiscard]] Result<image::Image8> preview_of_pack(const std::filesystem::path& file);

} // namespace frustumscreen::programs
