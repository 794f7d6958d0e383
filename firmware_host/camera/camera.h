/// A camera that looks at the table: its latest frame, as light and dark. Colour is left out: whatever looks at the table by a
/// camera asks where it is light.
///
/// Frame    pixels of camera C, row 0 at the top, as the camera sends them.
/// Units    luma codes from 0 to 255, in the camera's own range.
/// Threads  one caller; nothing here waits for the device.
/// Memory   frames live in memory alone: no file but the camera itself is opened for writing, nothing is written to that, and
///          nothing leaves the process (tests/camera/keeps_nothing_test.cpp, tests/hil/test_camera.py).
#pragma once

#include "firmware_host/base/time.h"
#include "firmware_host/camera/camera_set_up.h"
#include "firmware_host/camera/camera_state.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct CameraFrame {
    MonotonicTime time;       ///< when the kernel says that it was taken
    std::uint64_t number = 0; ///< of the frames handed on since the exhibit started, from 1
    int width = 0, height = 0;
    std::vector<std::uint8_t> luma; ///< [height][width], row-major
};

/// What is done with each frame on the device's own thread, before it is handed on; it may take long, and then frames are overtaken or passed over.
using FrameUse = std::function<void(const CameraFrame& frame)>;

/// Since the exhibit started.
struct CameraCounts {
    std::uint64_t connections = 0; ///< times that a camera was set up
    std::uint64_t frames = 0;      ///< handed on
    std::uint64_t overtaken = 0;   ///< whole, but a later one was there already
    std::uint64_t passed_over =
        0;                    ///< not even decoded, so that the camera's thread keeps its share of a core
    std::uint64_t lost = 0;   ///< numbers missing in the kernel's count of frames
    std::uint64_t broken = 0; ///< marked as broken by the kernel, too short, or not to be decoded
};

class Camera {
public:
    virtual ~Camera() = default;
    /// Hands over the latest frame, each once, by exchanging it for `frame`, whose memory is filled anew. False: there is none
    /// since, or the device's thread is just putting one.
    [[nodiscard]] virtual bool poll(CameraFrame& frame) = 0;
    [[nodiscard]] virtual CameraState state() const = 0;
    /// Frames a second that came of late.
    [[nodiscard]] virtual double rate_hz() const = 0;
    [[nodiscard]] virtual CameraCounts counts() const = 0;
    /// How the open camera is set, or the one before; nothing: none was set up yet.
    [[nodiscard]] virtual std::optional<CameraSetUp> set_up() const = 0;
    /// Until when its thread has promised to be heard from again; nothing: it has none.
    [[nodiscard]] virtual std::optional<MonotonicTime> alive_until() const { return {}; }
};

} // namespace frustumscreen
