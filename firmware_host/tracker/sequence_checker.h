/// The sequence checker: turns a device's frames into samples, checks their order and converts device time to
/// ours.
///
/// Frame    tracker K.
/// Time     `arrival` is the time at which the bytes came; a sample's time is the device's, mapped to the
///          monotonic clock.
/// Threads  one caller; allocates nothing once `samples` has enough space.
#pragma once

#include "firmware_host/tracker/device_clock.h"
#include "firmware_host/tracker/device_frame.h"
#include "firmware_host/tracker/usb_tracker_state.h"

#include <optional>

namespace frustumscreen::tracker {

class SequenceChecker {
public:
    explicit SequenceChecker(double tick_ns) : clock_(tick_ns) {}

    /// Returns true if any pose of the frame was taken. Repeated, late and implausible counters are refused.
    bool take(const DeviceFrame& frame, MonotonicTime arrival, std::vector<PoseSample>& samples);
    void count_refusal() { ++counts_.broken; }
    /// Counts of this device alone.
    [[nodiscard]] TrackerCounts counts() const;
    /// Time at which the last frame was taken.
    [[nodiscard]] std::optional<MonotonicTime> latest() const { return latest_; }
    /// A device that sends no frame for longer than this is silent. Derived from the intervals between its
    /// frames.
    [[nodiscard]] Nanoseconds timeout() const;
    /// Streaming, SensorMissing, DeviceFault, PosesUnusable, PosesLate or MetalNear.
    [[nodiscard]] UsbTrackerState state(MonotonicTime now) const;

private:
    enum class Order { Next, Refused };
    [[nodiscard]] Order order_of(int sensor, std::uint32_t counter);

    struct Sequence {
        std::optional<std::uint32_t> last;
        std::optional<std::uint32_t> implausible; ///< out of order; accepted if enough consistent ones follow
        int implausible_run = 0;
    };
    DeviceClock clock_;
    std::array<Sequence, 129> sequences_; ///< by sensor; 7 bits, from 1
    TrackerCounts counts_;                ///< without the clock's counts
    std::optional<MonotonicTime> latest_;
    std::uint32_t latest_counter_ = 0;
    Nanoseconds longest_gap_{0}; ///< between recent frames; decays slowly
    std::optional<MonotonicTime> began_;
    std::optional<MonotonicTime> prop_seen_;
    std::optional<MonotonicTime> prop_usable_;
    std::optional<MonotonicTime> faulty_;
    std::optional<MonotonicTime> late_;
    std::optional<MonotonicTime> distorted_;
};

} // namespace frustumscreen::tracker
