#include "firmware_host/tracker/usb_tracker.h"

#include "firmware_host/base/device_thread.h"

namespace frustumscreen::tracker {

UsbTracker::UsbTracker(std::unique_ptr<UsbBus> bus, const UsbTrackerSetUp& set_up, PacketTap* tap)
    : table_frame_(bus->reports_table_frame()), driver_(std::move(bus), set_up, monotonic_now, tap),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void UsbTracker::run(const std::stop_token& stop) {
    begin_device_thread("tracker");
    std::vector<PoseSample> samples;
    samples.reserve(max_waiting);
    while (!stop.stop_requested()) {
        heartbeat_.promise(monotonic_now() + (driver_.is_open() ? longest_round : longest_search));
        samples.clear();
        const Nanoseconds pause = driver_.step(samples);
        if (!samples.empty()) {
            mailbox_.put(samples);
        }
        state_ = driver_.state();
        {
            const std::lock_guard lock(counts_mutex_);
            counts_ = driver_.counts();
        }
        sleep_until_stop(stop, pause);
    }
}

Result<void> UsbTracker::poll(MonotonicTime now, std::vector<PoseSample>& samples) {
    mailbox_.take(now, samples);
    if (const std::unique_lock lock(counts_mutex_, std::try_to_lock); lock.owns_lock()) {
        seen_counts_ = counts_;
    }
    return {};
}

} // namespace frustumscreen::tracker
