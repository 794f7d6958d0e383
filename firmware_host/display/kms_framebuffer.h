/// Makes a piece of a graphics card's memory a framebuffer for scanout, 8 bits a channel, without alpha.
///
/// Threads  the render thread.
/// Errors   0: the card refuses it.
#pragma once

#include "firmware_host/display/kms_device.h"

#include <cstdint>

namespace frustumscreen::display {

/// `handle`: the memory's GEM handle on this card; `stride`: bytes of a row.
[[nodiscard]] FramebufferId add_framebuffer(int card, PixelSize size, std::uint32_t handle,
                                            std::uint32_t stride);
/// Does nothing for 0.
void remove_framebuffer(int card, FramebufferId framebuffer);

} // namespace frustumscreen::display
