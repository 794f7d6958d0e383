/// What `frustumscreen camera` found, in words and as JSON. It has numbers of frames and never a picture.
///
/// Threads  values.
#pragma once

#include "app/settings/settings.h"
#include "firmware_host/camera/camera.h"
#include "firmware_host/camera/camera_driver.h"
#include "firmware_host/camera/frame_judge.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

struct CameraChange {
    MonotonicTime at; ///< on the monotonic clock, as the kernel's log has it
    CameraState state = CameraState::NotConnected;
};

struct CameraReport {
    std::vector<FoundCamera> found;
    bool is_on = false; ///< in the settings; all that follows is empty where it is not
    MonotonicTime begun;
    double seconds = 0.0;
    CameraState state = CameraState::NotConnected;
    std::optional<CameraSetUp> set_up;
    CameraCounts counts;
    double rate_hz = 0.0;
    std::optional<FrameLook> last_look;
    std::vector<CameraChange> changes; ///< the first is the state at the beginning
};

[[nodiscard]] std::string camera_text(const CameraReport& report, const CameraSettings& wished);
[[nodiscard]] std::string camera_json(const CameraReport& report);

} // namespace frustumscreen
