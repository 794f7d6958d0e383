/// The driver of a camera: it searches, sets up, streams, and searches again after a loss. It takes the first
/// matching camera that can be set up; one that failed is tried last.
///
/// Time     read from `clock`, because a wait takes time. A camera that returns is found within
///          `between_searches` and streams after one set-up; it counts as well after FrameHealth::dwell of
///          good frames: together below 2 s.
/// Share    frames are skipped, so that decoding, judging and using the others takes at most `share` of one core
///          (cpu_throttle.h).
/// Threads  one caller; a step waits for at most one frame, and a set-up for some twenty control transfers.
/// Errors   none; `state` describes them.
#pragma once

#include "firmware_host/camera/camera.h"
#include "firmware_host/camera/frame_health.h"
#include "firmware_host/camera/v4l2_stream.h"

#include <functional>
#include <memory>

namespace frustumscreen::camera {

/// A camera that the kernel lists.
struct FoundCamera {
    std::string path, name, bus;
    std::vector<CameraMode> modes; ///< only those in a readable format
};
/// All cameras that can be opened.
[[nodiscard]] std::vector<FoundCamera> list_cameras(V4l2Devices& devices, const CameraRequest& request);

class CameraDriver {
public:
    static constexpr Nanoseconds between_searches = std::chrono::milliseconds(250);
    static constexpr Nanoseconds frame_timeout = std::chrono::milliseconds(50);
    /// A camera that is silent or sends broken frames for longer is set up again.
    static constexpr Nanoseconds max_silence = std::chrono::seconds(3);

    using Clock = std::function<MonotonicTime()>;
    CameraDriver(std::unique_ptr<V4l2Devices> devices, CameraRequest request, Clock clock, FrameUse use = {},
                 CpuThrottle share = CpuThrottle(1.0));

    struct Step {
        bool fresh = false;  ///< a frame was taken
        Nanoseconds pause{}; ///< pause before the next step
    };
    /// One round; a frame that was taken has already been used.
    [[nodiscard]] Step step(CameraFrame& frame);
    [[nodiscard]] CameraState state() const { return state_; }
    [[nodiscard]] bool is_open() const { return stream_ != nullptr; }
    [[nodiscard]] const CameraCounts& counts() const { return counts_; }
    /// Settings of the open camera, or of the previous one.
    [[nodiscard]] const std::optional<CameraSetUp>& set_up() const { return set_up_; }
    [[nodiscard]] double rate_hz();

private:
    [[nodiscard]] Nanoseconds search();
    [[nodiscard]] tl::expected<void, CameraState> open(const std::string& path);
    [[nodiscard]] Nanoseconds lose(CameraState state);
    void judge(MonotonicTime now);

    std::unique_ptr<V4l2Devices> devices_;
    CameraRequest request_;
    Clock clock_;
    FrameUse use_; ///< may be empty
    CpuThrottle pace_;
    std::unique_ptr<V4l2Stream> stream_;
    std::optional<FrameHealth> judge_; ///< of the open camera
    std::optional<CameraSetUp> set_up_;
    std::string path_;                ///< of the open camera
    std::string failed_;              ///< the path that failed last
    MonotonicTime heard_;             ///< time of the last whole frame, or of the opening
    bool has_sent_ = false;           ///< a whole frame has come
    std::uint64_t broken_before_ = 0; ///< count at the last whole frame
    CameraCounts counts_;
    CameraState state_ = CameraState::NotConnected;
};

} // namespace frustumscreen::camera
