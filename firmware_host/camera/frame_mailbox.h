/// Hands the latest frame from the camera's thread to another by swapping memory: no frame is copied, and
/// once three buffers have their size nothing is allocated.
///
/// Threads  one puts, one takes; taking never waits.
#pragma once

#include "firmware_host/camera/camera.h"

#include <mutex>
#include <utility>

namespace frustumscreen::camera {

class FrameMailbox {
public:
    /// `frame` becomes an old one, whose memory can be reused.
    void put(CameraFrame& frame) {
        const std::lock_guard lock(mutex_);
        std::swap(frame_, frame);
        fresh_ = true;
    }
    /// False: there is no new frame, or the other side is putting one; `frame` is then unchanged.
    [[nodiscard]] bool try_take(CameraFrame& frame) {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock.owns_lock() || !fresh_) {
            return false;
        }
        std::swap(frame_, frame);
        fresh_ = false;
        return true;
    }

private:
    std::mutex mutex_;
    CameraFrame frame_;
    bool fresh_ = false;
};

} // namespace frustumscreen::camera
