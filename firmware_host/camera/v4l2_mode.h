/// Format, size and rate of a V4L2 camera: listed, chosen, and read back.
///
/// Threads  the camera's own.
/// Errors   a CameraState: InUse, NoFormat, SetUpRefused.
#pragma once

#include "firmware_host/camera/camera_set_up.h"
#include "firmware_host/camera/camera_state.h"
#include "firmware_host/camera/v4l2_device.h"

#include <optional>
#include <span>

namespace frustumscreen::camera {

/// Layout of a frame in a camera's buffer.
struct FrameFormat {
    PixelFormat format = PixelFormat::Grey;
    int width = 0, height = 0;
    std::size_t row_bytes = 0;
};

struct SetMode {
    FrameFormat frame;
    double rate_hz = 0.0; ///< 0: not reported by the driver
};

/// All modes in a readable format; for a range, the value nearest to the request.
[[nodiscard]] std::vector<CameraMode> list_modes(V4l2Device& device, const CameraRequest& request);

/// Among the modes of the size nearest to the request, the one that reaches the rate, or is fastest; then the
/// format that is cheapest to decode. nullopt: there are no modes.
[[nodiscard]] std::optional<CameraMode> choose_mode(std::span<const CameraMode> modes,
                                                    const CameraRequest& request);

/// Returns the mode that the driver has accepted.
[[nodiscard]] tl::expected<SetMode, CameraState> set_mode(V4l2Device& device, const CameraMode& mode);

} // namespace frustumscreen::camera
