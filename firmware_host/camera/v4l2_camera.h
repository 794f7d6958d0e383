/// A V4L2 camera as the exhibit sees it: the device has its own thread, which also judges its frames.
///
/// Threads  the class starts and joins a thread that opens, reads and closes the device. The other functions
///          never wait, whatever the device does. The destructor waits for the kernel call in progress.
/// Errors   none; `state` describes them.
#pragma once

#include "firmware_host/base/heartbeat.h"
#include "firmware_host/camera/camera_driver.h"
#include "firmware_host/camera/frame_mailbox.h"

#include <atomic>
#include <mutex>
#include <stop_token>
#include <thread>

namespace frustumscreen::camera {

class V4l2Camera final : public Camera {
public:
    /// A set-up makes some twenty control transfers, and the kernel gives up each after 5 s. Devices that
    /// slow are very rare, so a minute is promised.
    static constexpr Nanoseconds longest_search = std::chrono::seconds(60);
    /// Longest wait for a frame, its decoding, and the closing of a lost camera.
    static constexpr Nanoseconds longest_round = std::chrono::seconds(10);

    /// `max_share`: limit of the thread's processor time, as a share of one core.
    V4l2Camera(std::unique_ptr<V4l2Devices> devices, CameraRequest request, FrameUse use = {},
               double max_share = 1.0);

    [[nodiscard]] bool poll(CameraFrame& frame) override { return mailbox_.try_take(frame); }
    [[nodiscard]] CameraState state() const override { return state_; }
    [[nodiscard]] double rate_hz() const override { return rate_hz_; }
    [[nodiscard]] CameraCounts counts() const override;
    [[nodiscard]] std::optional<CameraSetUp> set_up() const override;
    [[nodiscard]] std::optional<MonotonicTime> alive_until() const override {
        return heartbeat_.promised_until();
    }

private:
    void run(const std::stop_token& stop);

    CameraDriver driver_; ///< the device's thread only
    FrameMailbox mailbox_;
    std::atomic<CameraState> state_{CameraState::NotConnected};
    std::atomic<double> rate_hz_{0.0};
    mutable std::mutex told_mutex_; ///< held only for a copy
    CameraCounts counts_;
    std::optional<CameraSetUp> set_up_;
    Heartbeat heartbeat_{monotonic_now() + longest_search};
    std::jthread thread_; ///< last: it uses all members above
};

} // namespace frustumscreen::camera
