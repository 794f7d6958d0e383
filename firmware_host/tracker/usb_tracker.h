/// A USB tracker as the exhibit sees it: the device has its own thread; `poll` only reads the mailbox.
///
/// Frame    tracker K; VIPER, PATRIOT and LIBERTY by default have +Z pointing down. A SpaceMouse: table T.
/// Threads  the class starts and joins a thread that does all USB work. `poll` and `state` never wait,
///          whatever the device does. The destructor waits for the USB call in progress.
/// Errors   none; `state` describes them.
#pragma once

#include "firmware_host/base/heartbeat.h"
#include "firmware_host/base/mailbox.h"
#include "firmware_host/tracker/usb_tracker_driver.h"

#include <atomic>
#include <mutex>
#include <stop_token>
#include <thread>

namespace frustumscreen::tracker {

class UsbTracker final : public Tracker {
public:
    static constexpr std::size_t max_waiting = 256;
    /// Longest search and opening: two control transfers, which the kernel gives up after 5 s each.
    static constexpr Nanoseconds longest_search = std::chrono::seconds(10);
    /// One write and one read of an open device, with the driver's limits for both. Closing a dying device
    /// takes the kernel longer; the service manager's watchdog allows for that.
    static constexpr Nanoseconds longest_round = std::chrono::milliseconds(500);

    /// `tap`, if any, outlives the tracker and is called on the device's thread.
    UsbTracker(std::unique_ptr<UsbBus> bus, const UsbTrackerSetUp& set_up, PacketTap* tap = nullptr);

    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<PoseSample>& samples) override;
    [[nodiscard]] std::string name() const override { return "usb"; }
    [[nodiscard]] bool reports_table_frame() const override { return table_frame_; }
    [[nodiscard]] std::string_view state() const override { return sentence_of(state_); }
    [[nodiscard]] DeviceCondition condition() const override { return condition_of(state_); }
    [[nodiscard]] TrackerHealth health() const override { return health_of(state_); }
    [[nodiscard]] bool hangs() const override { return frustumscreen::tracker::hangs(state_); }
    [[nodiscard]] TrackerCounts counts() const override { return seen_counts_; }
    [[nodiscard]] std::optional<MonotonicTime> alive_until() const override {
        return heartbeat_.promised_until();
    }

private:
    void run(const std::stop_token& stop);

    bool table_frame_;
    UsbTrackerDriver driver_; ///< the device's thread only
    Mailbox<PoseSample, max_waiting> mailbox_;
    std::atomic<UsbTrackerState> state_{UsbTrackerState::NotConnected};
    TrackerCounts counts_; ///< with the lock held
    std::mutex counts_mutex_;
    TrackerCounts seen_counts_; ///< used by the caller of `poll` only
    Heartbeat heartbeat_{monotonic_now() + longest_search};
    std::jthread thread_; ///< last: it uses all members above
};

} // namespace frustumscreen::tracker
