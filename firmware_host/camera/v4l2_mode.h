/// Which format, size and rate a V4L2 camera sends: listed, chosen, and read back.
///
/// Threads  the camera's own.
/// Errors   a CameraState: InUse, NoFormat, SetUpRefused.
#pragma once

#include "firmware_host/camera/camera_set_up.h"
#include "firmware_host/camera/camera_state.h"
#include "firmware_host/camera/v4l2_device.h"

#include <optional>
#include <span>

namespace frustumscreen {

/// What comes out of a camera's buffer.
struct FrameFormat {
    PixelFormat format = PixelFormat::Grey;
    int width = 0, height = 0;
    std::size_t row_bytes = 0;
};

struct SetMode {
    FrameFormat frame;
    double rate_hz = 0.0; ///< 0: the driver does not say
};

/// All that the camera offers in a format that can be read; where it offers a range, what comes next to the wish.
[[nodiscard]] std::vector<CameraMode> list_modes(V4l2Device& device, const CameraWish& wish);

/// Of the size that is nearest to the wish, the mode that reaches the rate, or is fastest; of those the format that costs least.
/// Nothing: there are none.
[[nodiscard]] std::optional<CameraMode> choose_mode(std::span<const CameraMode> modes,
                                                    const CameraWish& wish);

/// Returns what the driver has made of it.
[[nodiscard]] tl::expected<SetMode, CameraState> set_mode(V4l2Device& device, const CameraMode& mode);

} // namespace frustumscreen
