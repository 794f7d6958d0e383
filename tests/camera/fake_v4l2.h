/// A fake camera behind the kernel's V4L2 interface. It follows the kernel's rules (a buffer is filled only
/// while it is queued, a format cannot be set while buffers exist), and has the faults that a test sets.
///
/// Time     a clock that only its waits advance, or the machine's.
/// Threads  the camera's and the test's: members that a test changes while a camera runs are atomic or
///          guarded by `mutex`.
#pragma once

#include "firmware_host/camera/v4l2_device.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace frustumscreen::camera {

using Picture = std::vector<std::uint8_t>;

struct FakeSize {
    std::uint32_t width, height;
    std::vector<std::uint32_t> rates_hz;
};
struct FakeFormat {
    std::uint32_t fourcc;
    std::vector<FakeSize> sizes;
};
struct FakeControl {
    std::int32_t value = 0, least = 0, most = 0;
    bool stubborn = false; ///< accepts a value but keeps its own
};

struct FakeCamera {
    std::mutex mutex;
    std::string name = "Fake Camera";
    std::vector<FakeFormat> formats;
    std::map<std::uint32_t, FakeControl> controls;
    std::function<Picture(std::uint64_t)> picture; ///< the bytes of the frame of this number
    std::uint32_t row_padding = 0;
    bool real_time = false;
    std::atomic<bool> plugged{true};
    std::atomic<bool> sends{true};
    std::atomic<int> open_error{0};
    std::atomic<int> format_error{0}, start_error{0};
    std::atomic<bool> marks_broken{false};
    std::atomic<double> slower{1.0};     ///< factor of its negotiated interval
    std::atomic<std::uint32_t> skips{0}; ///< frame numbers skipped once
    std::atomic<int> opened{0}, started{0}, unmapped{0};
    std::atomic<int> streams{0}; ///< number of active streams

    /// Simulated time; several cameras may share it.
    std::shared_ptr<MonotonicTime> now = std::make_shared<MonotonicTime>(std::chrono::seconds(100));
    [[nodiscard]] MonotonicTime clock() const { return real_time ? monotonic_now() : *now; }
};

class FakeDevices final : public V4l2Devices {
public:
    /// `cameras` must outlive this; they are /dev/video0, 1, ...
    explicit FakeDevices(std::vector<FakeCamera*> cameras) : cameras_(std::move(cameras)) {}
    [[nodiscard]] std::vector<std::string> list() override;
    [[nodiscard]] tl::expected<std::unique_ptr<V4l2Device>, int> open(const std::string& path) override;

private:
    std::vector<FakeCamera*> cameras_;
};

/// GREY and YUYV of 64 x 48 at 30 and 15 Hz, with all controls on automatic; a noisy picture.
void make_usual(FakeCamera& camera);

/// A grey ramp with noise that changes from frame to frame, each luma byte followed by `bytes_each - 1`
/// others.
[[nodiscard]] Picture noisy_ramp(int width, int height, std::uint64_t number, int bytes_each = 1);

} // namespace frustumscreen::camera
