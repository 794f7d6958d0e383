#include "firmware_host/display/kms_framebuffer.h"

#include <array>

extern "C" {
#include <drm_fourcc.h>
#include <xf86drm.h>
#include <xf86drmMode.h>
}

namespace frustumscreen::display {

/// Passes no modifiers, so the driver lays memory out as the kernel expects. Old drivers only accept depth
/// and bits.
FramebufferId add_framebuffer(int card, PixelSize size, std::uint32_t handle, std::uint32_t stride) {
    const auto width = static_cast<std::uint32_t>(size.width);
    const auto height = static_cast<std::uint32_t>(size.height);
    const std::array<std::uint32_t, 4> handles{handle};
    const std::array<std::uint32_t, 4> strides{stride};
    const std::array<std::uint32_t, 4> offsets{};
    FramebufferId framebuffer = 0;
    if (drmModeAddFB2(card, width, height, DRM_FORMAT_XRGB8888, handles.data(), strides.data(),
                      offsets.data(), &framebuffer, 0) == 0 ||
        drmModeAddFB(card, width, height, 24, 32, stride, handle, &framebuffer) == 0) {
        return framebuffer;
    }
    return 0;
}

void remove_framebuffer(int card, FramebufferId framebuffer) {
    if (framebuffer != 0) {
        drmModeRmFB(card, framebuffer);
    }
}

} // namespace frustumscreen::display
