/// A camera that looks at the table: its latest frame, brightness only. Colour is dropped, because all users
/// of the frames only need brightness.
///
/// Frame    pixels of camera C, row 0 at the top, as the camera sends them.
/// Units    luma codes from 0 to 255, in the camera's own range.
/// Threads  one caller; no function waits for the device.
/// Memory   frames stay in memory: only the camera itself is opened for writing, nothing is written to it,
///          and nothing leaves the process (tests/camera/keeps_nothing_test.cpp, tests/hil/test_camera.py).
#pragma once

#include "firmware_host/base/time.h"
#include "firmware_host/camera/camera_set_up.h"
#include "firmware_host/camera/camera_state.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace frustumscreen::camera {

struct CameraFrame {
    MonotonicTime time;       ///< capture time, from the kernel
    std::uint64_t number = 0; ///< number of the frame since the exhibit started, from 1
    int width = 0, height = 0;
    std::vector<std::uint8_t> luma; ///< [height][width], row-major
};

/// Called with each frame on the device's thread, before the frame is handed on. It may take long; frames are
/// then overtaken or skipped.
using FrameUse = std::function<void(const CameraFrame& frame)>;

/// Counts since the exhibit started.
struct CameraCounts {
    std::uint64_t connections = 0; ///< times that a camera was set up
    std::uint64_t frames = 0;      ///< handed on
    std::uint64_t overtaken = 0;   ///< intact, but superseded by a later frame
    std::uint64_t skipped = 0;     ///< not decoded, to limit the CPU load
    std::uint64_t lost = 0;        ///< numbers missing in the kernel's count of frames
    std::uint64_t broken = 0;      ///< marked as broken by the kernel, too short, or not decodable
};

class Camera {
public:
    virtual ~Camera() = default;
    /// Hands over the latest frame, each once, by swapping it with `frame`, whose memory is reused. False:
    /// there is no new frame, or the device's thread is just putting one.
    [[nodiscard]] virtual bool poll(CameraFrame& frame) = 0;
    [[nodiscard]] virtual CameraState state() const = 0;
    /// Rate of recent frames, per second.
    [[nodiscard]] virtual double rate_hz() const = 0;
    [[nodiscard]] virtual CameraCounts counts() const = 0;
    /// Settings of the open camera, or of the previous one; nullopt: no camera was set up yet.
    [[nodiscard]] virtual std::optional<CameraSetUp> set_up() const = 0;
    /// Time until which the device's thread has promised a sign of life; nullopt: there is no such thread.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return {}; }
};

} // namespace frustumscreen::camera
