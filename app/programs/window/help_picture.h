/// The functions of mouse and keys, as a picture over the window.
///
/// Errors   the typeface's files are missing.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/window/sdl_window.h"

namespace frustumscreen::programs {

[[nodiscard]] Result<window::WindowHelp> help_picture();

} // namespace frustumscreen::programs
