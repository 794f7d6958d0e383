/// Hands the latest frame from the camera's thread to another by exchanging memory: no frame is copied, and once three have their
/// size nothing is allocated.
///
/// Threads  one puts, one takes; the latter never waits.
#pragma once

#include "firmware_host/camera/camera.h"

#include <mutex>
#include <utility>

namespace frustumscreen {

class FrameMailbox {
public:
    /// `frame` becomes one whose memory may be filled anew.
    void put(CameraFrame& frame) {
        const std::lock_guard lock(mutex_);
        std::swap(frame_, frame);
        fresh_ = true;
    }
    /// False: none was put since, or the other side is at it; then `frame` stays as it is.
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

} // namespace frustumscreen
