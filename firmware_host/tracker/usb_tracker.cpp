#include "firmware_host/tracker/usb_tracker.h"

namespace frustumscreen {

namespace {

MonotonicTime steady_now() {
    return std::chrono::time_point_cast<Nanoseconds>(std::chrono::steady_clock::now());
}

} // namespace

UsbTracker::UsbTracker(std::unique_ptr<UsbBus> bus, const UsbTrackerSetUp& set_up)
    : driver_(std::move(bus), set_up, steady_now), thread_([this] { run(); }) {}

UsbTracker::~UsbTracker() {
    {
        const std::lock_guard lock(stop_mutex_);
        stop_ = true;
    }
    stop_asked_.notify_all();
    thread_.join();
}

void UsbTracker::run() {
    std::vector<PoseSample> samples;
    samples.reserve(SampleMailbox::capacity);
    while (true) {
        samples.clear();
        const Nanoseconds rest = driver_.step(samples);
        if (!samples.empty()) {
            mailbox_.put(samples);
        }
        state_ = driver_.state();
        std::unique_lock lock(stop_mutex_);
        if (stop_asked_.wait_for(lock, rest, [this] { return stop_; })) {
            return;
        }
    }
}

Result<void> UsbTracker::poll(MonotonicTime now, std::vector<PoseSample>& samples) {
    mailbox_.take(now, samples);
    const UsbTrackerState state = state_;
    const bool lost = was_streaming_ && !is_streaming(state);
    was_streaming_ = is_streaming(state);
    if (lost) {
        return fail(ErrorKind::DeviceLost, std::string(sentence_of(state)));
    }
    return {};
}

} // namespace frustumscreen
