/// Framebuffers in plain memory of a card, for which another GPU or the processor draws; every picture is
/// copied into them. All display drivers have such memory.
///
/// Threads  the render thread.
/// Errors   one clause that names what the card lacks.
/// Source   the kernel's "Dumb Buffer Objects": DRM_IOCTL_MODE_CREATE_DUMB, _MAP_DUMB.
#pragma once

#include "firmware_host/display/card_screen.h"

#include <memory>

namespace frustumscreen::display {

/// `screen` must outlive the result.
[[nodiscard]] Result<std::unique_ptr<ScanoutPair>> make_dumb_scanout(const CardScreen& screen,
                                                                     PixelSize size);

} // namespace frustumscreen::display
