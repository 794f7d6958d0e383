/// Framebuffers in plain memory of a card that another GPU, or the processor, draws for: every picture is
/// copied into them. All drivers of displays have such memory.
///
/// Threads  the render thread.
/// Errors   one clause: what the card has not.
/// Source   the kernel's "Dumb Buffer Objects": DRM_IOCTL_MODE_CREATE_DUMB, _MAP_DUMB.
#pragma once

#include "firmware_host/display/card_screen.h"

#include <memory>

namespace frustumscreen {

/// `screen` outlives it.
[[nodiscard]] Result<std::unique_ptr<ScanoutPair>> make_dumb_scanout(const CardScreen& screen,
                                                                     PixelSize size);

} // namespace frustumscreen
