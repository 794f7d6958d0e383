/// Turns a device's frames into samples: checks their sequence and converts the device's time to ours.
///
/// Frame    tracker K.
/// Time     `arrival` is when the bytes came; a sample's time is the device's, on the monotonic clock.
/// Threads  one caller; allocates nothing once `samples` has enough room.
#pragma once

#include "firmware_host/tracker/device_clock.h"
#include "firmware_host/tracker/device_frame.h"
#include "firmware_host/tracker/usb_tracker_state.h"

#include <optional>

namespace frustumscreen {

class FrameIntake {
public:
    explicit FrameIntake(double tick_ns) : clock_(tick_ns) {}

    /// True if any pose of it was taken. Those that came twice, late or with a strange counter are refused.
    bool take(const DeviceFrame& frame, MonotonicTime arrival, std::vector<PoseSample>& samples);
    void count_refusal() { ++counts_.broken; }
    /// Of this one device.
    [[nodiscard]] TrackerCounts counts() const;
    /// When a frame was taken last.
    [[nodiscard]] std::optional<MonotonicTime> latest() const { return latest_; }
    /// A device without a frame for longer than this is silent; it follows from the pace of its frames.
    [[nodiscard]] Nanoseconds patience() const;
    /// Streaming, SensorMissing, DeviceFault, PosesUnusable, PosesLate or MetalNear.
    [[nodiscard]] UsbTrackerState state(MonotonicTime now) const;

private:
    enum class Order { Next, Refused };
    [[nodiscard]] Order order_of(int sensor, std::uint32_t counter);

    struct Sequence {
        std::optional<std::uint32_t> last;
        std::optional<std::uint32_t> strange; ///< out of order; believed once enough later ones came
        int strange_run = 0;
    };
    DeviceClock clock_;
    std::array<Sequence, 129> sequences_; ///< by sensor; 7 bits, from 1
    TrackerCounts counts_;                ///< without the clock's
    std::optional<MonotonicTime> latest_;
    std::uint32_t latest_counter_ = 0;
    Nanoseconds longest_gap_{0}; ///< between two of the latest frames
    std::optional<MonotonicTime> began_;
    std::optional<MonotonicTime> prop_seen_;
    std::optional<MonotonicTime> prop_usable_;
    std::optional<MonotonicTime> faulty_;
    std::optional<MonotonicTime> late_;
    std::optional<MonotonicTime> distorted_;
};

} // namespace frustumscreen
