/// Locks exposure, gain and white balance of a V4L2 camera: automatic off, value set, and read back. A camera
/// that changes them by itself would mistake the projector's picture for a change of light.
///
/// Threads  the camera's own.
/// Errors   none: each control's row reports a failure.
#pragma once

#include "firmware_host/camera/camera_set_up.h"
#include "firmware_host/camera/v4l2_device.h"

namespace frustumscreen::camera {

/// In this order: exposure, gain, white balance.
[[nodiscard]] std::vector<LockedControl> lock_controls(V4l2Device& device, const CameraRequest& request);

} // namespace frustumscreen::camera
