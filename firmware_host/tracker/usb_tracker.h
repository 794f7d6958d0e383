/// A USB tracker as the exhibit sees it: the device has a thread of its own, `poll` only looks into the
/// mailbox.
///
/// Frame    tracker K; VIPER, PATRIOT and LIBERTY by default have +Z pointing down.
/// Threads  everything of USB happens on the thread that this class starts and joins; `poll` and `state` wait
/// for
///          nothing, whatever the device does. The destructor waits for the one USB call that may be under
///          way.
/// Errors   DeviceLost, once each time that the poses stop; `state` says why.
#pragma once

#include "firmware_host/tracker/sample_mailbox.h"
#include "firmware_host/tracker/usb_tracker_driver.h"

#include <atomic>
#include <condition_variable>
#include <thread>

namespace frustumscreen {

class UsbTracker final : public Tracker {
public:
    UsbTracker(std::unique_ptr<UsbBus> bus, const UsbTrackerSetUp& set_up);
    ~UsbTracker() override;
    UsbTracker(const UsbTracker&) = delete;
    UsbTracker& operator=(const UsbTracker&) = delete;

    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<PoseSample>& samples) override;
    [[nodiscard]] std::string name() const override { return "usb"; }
    [[nodiscard]] bool reports_table_frame() const override { return false; }
    [[nodiscard]] std::string_view state() const override { return sentence_of(state_); }

private:
    void run();

    UsbTrackerDriver driver_; ///< the device's thread only
    SampleMailbox mailbox_;
    std::atomic<UsbTrackerState> state_{UsbTrackerState::NotConnected};
    bool was_streaming_ = false; ///< poll's side
    std::mutex stop_mutex_;
    std::condition_variable stop_asked_;
    bool stop_ = false;
    std::thread thread_; ///< last: everything else is there before it begins
};

} // namespace frustumscreen
