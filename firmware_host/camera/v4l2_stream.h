/// A streaming V4L2 camera: its mapped buffers, and their latest whole frame.
///
/// Threads  the camera's own; `take` waits no longer than `timeout`.
#pragma once

#include "firmware_host/camera/camera.h"
#include "firmware_host/camera/cpu_throttle.h"
#include "firmware_host/camera/luma_reader.h"
#include "firmware_host/camera/v4l2_mode.h"

#include <functional>
#include <memory>
#include <span>

namespace frustumscreen::camera {

class V4l2Stream {
public:
    static constexpr std::uint32_t requested_buffers = 4;

    /// Errors: InUse, SetUpRefused.
    [[nodiscard]] static tl::expected<std::unique_ptr<V4l2Stream>, CameraState>
    start(std::unique_ptr<V4l2Device> device, const FrameFormat& format);
    ~V4l2Stream();
    V4l2Stream(const V4l2Stream&) = delete;
    V4l2Stream& operator=(const V4l2Stream&) = delete;

    enum class Taken : std::uint8_t { Frame, Skipped, Nothing, Lost };
    /// Takes the latest of the waiting frames; adds to `counts`. `now` is called after the wait. For a Frame,
    /// `pace.begin` was called; a frame that `pace` skips is not decoded.
    [[nodiscard]] Taken take(Nanoseconds timeout, const std::function<MonotonicTime()>& now,
                             CpuThrottle& pace, CameraFrame& frame, CameraCounts& counts);

private:
    V4l2Stream(std::unique_ptr<V4l2Device> device, const FrameFormat& format)
        : device_(std::move(device)), format_(format) {}

    [[nodiscard]] bool map_buffers();

    std::unique_ptr<V4l2Device> device_;
    FrameFormat format_;
    std::vector<std::span<const std::byte>> buffers_;
    LumaReader reader_;
    bool streams_ = false;
    std::optional<std::uint32_t> last_sequence_;
};

} // namespace frustumscreen::camera
