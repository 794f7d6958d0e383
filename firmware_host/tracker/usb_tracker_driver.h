/// The driver of a USB tracker: it searches, sets up, streams, and searches again after a loss. It takes the
/// first tracker that can be opened; one that fails is tried last from then on. An optional tap sees
/// everything between transport and session.
///
/// Time     read from `clock`, because a read takes time. A device that returns is found within
///          `between_searches` and streams after one set-up; both together take well below 2 s.
/// Threads  one caller; a step blocks for at most one write and one read.
/// Errors   none; `state` describes them.
#pragma once

#include "firmware_host/tracker/device_session.h"
#include "firmware_host/tracker/packet_tap.h"
#include "firmware_host/tracker/usb_transport.h"

#include <functional>

namespace frustumscreen::tracker {

class UsbTrackerDriver {
public:
    static constexpr Nanoseconds between_searches = std::chrono::milliseconds(250);
    static constexpr Nanoseconds write_timeout = std::chrono::milliseconds(200);
    static constexpr Nanoseconds read_timeout = std::chrono::milliseconds(20);

    using Clock = std::function<MonotonicTime()>;
    UsbTrackerDriver(std::unique_ptr<UsbBus> bus, const UsbTrackerSetUp& set_up, Clock clock,
                     PacketTap* tap = nullptr);

    /// One round; appends the samples. Returns the pause before the next round.
    [[nodiscard]] Nanoseconds step(std::vector<PoseSample>& samples);
    [[nodiscard]] UsbTrackerState state() const { return state_; }
    /// Whether a device is open, set up or not.
    [[nodiscard]] bool is_open() const { return transport_ != nullptr; }
    /// Counts of all devices since the start.
    [[nodiscard]] TrackerCounts counts() const;

private:
    static constexpr std::size_t max_failed = 4;

    [[nodiscard]] tl::expected<FoundTracker, UsbTrackerState> find();
    [[nodiscard]] Nanoseconds search();
    [[nodiscard]] Nanoseconds lose(UsbTrackerState state);
    void report(UsbTrackerState state);
    void tell_state();
    void tell(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload = {});

    std::unique_ptr<UsbBus> bus_;
    UsbTrackerSetUp set_up_;
    Clock clock_;
    PacketTap* tap_; ///< may be null
    std::unique_ptr<UsbTransport> transport_;
    std::unique_ptr<DeviceSession> session_;
    std::string place_;               ///< of the open device
    std::vector<std::string> failed_; ///< places of failed devices, the latest last
    TrackerCounts counts_;            ///< of the finished sessions, and the connections
    UsbTrackerState state_ = UsbTrackerState::NotConnected;
    /// A multiple of any bulk packet, so a transfer never overflows it.
    std::array<std::byte, 4096> buffer_{};
};

} // namespace frustumscreen::tracker
