/// Frames of a device into samples: the sequence is checked, the device's time becomes ours.
///
/// Frame    tracker K.
/// Time     `arrival` is when the bytes came; a sample's time is the device's, on the monotonic clock.
/// Threads  one caller; allocates nothing once `samples` has its room.
#pragma once

#include "firmware_host/tracker/device_clock.h"
#include "firmware_host/tracker/device_frame.h"
#include "firmware_host/tracker/usb_tracker_state.h"

#include <optional>

namespace frustumscreen {

struct IntakeCounts {
    std::uint64_t frames = 0;     ///< taken
    std::uint64_t lost = 0;       ///< numbers missing between two taken frames of a sensor
    std::uint64_t duplicated = 0; ///< came twice; refused
    std::uint64_t reordered = 0;  ///< came after a later one; refused
    std::uint64_t strange = 0;    ///< a counter far from what was due; refused
    std::uint64_t unusable = 0;   ///< poses that are none, or that the device disowns
    std::uint64_t refused = 0;    ///< times that bytes were thrown away by the codec
};

class FrameIntake {
public:
    explicit FrameIntake(double tick_ns) : clock_(tick_ns) {}

    /// Whether any of it was taken; nothing of a frame that came twice, late or from nowhere is.
    bool take(const DeviceFrame& frame, MonotonicTime arrival, std::vector<PoseSample>& samples);
    void count_refusal() { ++counts_.refused; }
    [[nodiscard]] const IntakeCounts& counts() const { return counts_; }
    [[nodiscard]] const DeviceClock& clock() const { return clock_; }
    /// When a frame was taken last.
    [[nodiscard]] std::optional<MonotonicTime> latest() const { return latest_; }
    /// Streaming, SensorMissing, PosesUnusable or MetalNear.
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
    IntakeCounts counts_;
    std::optional<MonotonicTime> latest_;
    std::optional<MonotonicTime> began_;
    std::optional<MonotonicTime> prop_seen_;
    std::optional<MonotonicTime> prop_usable_;
    std::optional<MonotonicTime> distorted_;
};

} // namespace frustumscreen
