#include "firmware_host/camera/v4l2_camera.h"

#include "firmware_host/base/device_thread.h"

namespace frustumscreen::camera {

V4l2Camera::V4l2Camera(std::unique_ptr<V4l2Devices> devices, CameraRequest request, FrameUse use,
                       double max_share)
    : driver_(std::move(devices), std::move(request), monotonic_now, std::move(use), CpuThrottle(max_share)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void V4l2Camera::run(const std::stop_token& stop) {
    begin_device_thread("camera");
    CameraFrame frame;
    while (!stop.stop_requested()) {
        heartbeat_.promise(monotonic_now() + (driver_.is_open() ? longest_round : longest_search));
        const auto [fresh, pause] = driver_.step(frame);
        if (fresh) {
            mailbox_.put(frame);
        }
        state_ = driver_.state();
        rate_hz_ = driver_.rate_hz();
        {
            const std::lock_guard lock(told_mutex_);
            counts_ = driver_.counts();
            set_up_ = driver_.set_up();
        }
        sleep_until_stop(stop, pause);
    }
}

CameraCounts V4l2Camera::counts() const {
    const std::lock_guard lock(told_mutex_);
    return counts_;
}

std::optional<CameraSetUp> V4l2Camera::set_up() const {
    const std::lock_guard lock(told_mutex_);
    return set_up_;
}

} // namespace frustumscreen::camera
