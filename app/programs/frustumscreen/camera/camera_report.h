/// The findings of `frustumscreen camera`, in words and as JSON. It has numbers about frames, never a picture.
///
/// Threads  values.
#pragma once

#include "app/settings/settings.h"
#include "firmware_host/camera/camera.h"
#include "firmware_host/camera/camera_driver.h"
#include "firmware_host/camera/frame_health.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct CameraChange {
    MonotonicTime at; ///< monotonic clock, as in the kernel's log
    camera::CameraState state = camera::CameraState::NotConnected;
};

struct CameraReport {
    std::vector<camera::FoundCamera> found;
    bool is_on = false; ///< switched on in the settings; if not, all that follows is empty
    MonotonicTime begun;
    double seconds = 0.0;
    camera::CameraState state = camera::CameraState::NotConnected;
    std::optional<camera::CameraSetUp> set_up;
    camera::CameraCounts counts;
    double rate_hz = 0.0;
    std::optional<camera::FrameLook> last_look;
    std::vector<CameraChange> changes; ///< the first is the state at the start
};

[[nodiscard]] std::string camera_text(const CameraReport& report, const settings::CameraSettings& requested);
[[nodiscard]] std::string camera_json(const CameraReport& report);

} // namespace frustumscreen::programs
