/// A V4L2 camera as the exhibit sees it: the device has its own thread, which also judges its frames.
///
/// Threads  the device is opened, read and closed on the thread that this class starts and joins; what is declared here waits for
///          nothing, whatever the device does. The destructor waits for the one call of the kernel under way.
/// Errors   none; `state` says what is the matter.
#pragma once

#include "firmware_host/base/heartbeat.h"
#include "firmware_host/camera/camera_driver.h"
#include "firmware_host/camera/frame_mailbox.h"

#include <atomic>
#include <mutex>
#include <stop_token>
#include <thread>

namespace frustumscreen {

class V4l2Camera final : public Camera {
public:
    /// A set-up makes some twenty control transfers, and the kernel gives up after 5 s for each: a device that is that slow is
    /// hardly ever seen, so a minute is promised.
    static constexpr Nanoseconds longest_search = std::chrono::seconds(60);
    /// A wait for a frame, its decoding, and the closing of a camera that is lost.
    static constexpr Nanoseconds longest_round = std::chrono::seconds(10);

    /// `most_share`: of one core, that its thread takes at most.
    V4l2Camera(std::unique_ptr<V4l2Devices> devices, CameraWish wish, FrameUse use = {},
               double most_share = 1.0);

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
    mutable std::mutex told_mutex_; ///< held for a copy only
    CameraCounts counts_;
    std::optional<CameraSetUp> set_up_;
    Heartbeat heartbeat_{monotonic_now() + longest_search};
    std::jthread thread_; ///< last: it uses all of the above
};

} // namespace frustumscreen
