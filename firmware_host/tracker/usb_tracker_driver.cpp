#include "firmware_host/tracker/usb_tracker_driver.h"

namespace frustumscreen::tracker {

UsbTrackerDriver::UsbTrackerDriver(std::unique_ptr<UsbBus> bus, const UsbTrackerSetUp& set_up, Clock clock,
                                   PacketTap* tap)
    : bus_(std::move(bus)), set_up_(set_up), clock_(std::move(clock)), tap_(tap) {
    tell_state();
}

void UsbTrackerDriver::tell(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload) {
    if (tap_ != nullptr) {
        tap_->packet(kind, time, payload);
    }
}

/// The driver retries a failed set-up without end. The reason for the failure tells more than SettingUp, so
/// it stays.
void UsbTrackerDriver::report(UsbTrackerState state) {
    const bool known_trouble = state_ == UsbTrackerState::WrongUnits ||
                               state_ == UsbTrackerState::SetUpRefused || state_ == UsbTrackerState::Silent ||
                               state_ == UsbTrackerState::Booting || state_ == UsbTrackerState::DeviceFault;
    if (state == state_ || (state == UsbTrackerState::SettingUp && known_trouble)) {
        return;
    }
    state_ = state;
    tell_state();
}

void UsbTrackerDriver::tell_state() {
    const std::string_view sentence = sentence_of(state_);
    tell(PacketKind::State, clock_(), std::as_bytes(std::span(sentence.data(), sentence.size())));
}

/// Finds a device that has not failed; otherwise the one that failed longest ago.
tl::expected<FoundTracker, UsbTrackerState> UsbTrackerDriver::find() {
    for (std::span<const std::string> but_not(failed_);; but_not = but_not.subspan(1)) {
        tl::expected<FoundTracker, UsbTrackerState> found = bus_->find(but_not);
        if (found || but_not.empty()) {
            return found;
        }
    }
}

Nanoseconds UsbTrackerDriver::search() {
    tl::expected<FoundTracker, UsbTrackerState> found = find();
    if (!found) {
        failed_.clear();
        report(found.error());
        return between_searches;
    }
    ++counts_.connections;
    place_ = std::move(found->place);
    transport_ = std::move(found->transport);
    session_ = make_session(found->model, set_up_);
    const OpenedDevice opened{found->model, set_up_};
    tell(PacketKind::Opened, clock_(), opened.bytes());
    report(UsbTrackerState::SettingUp);
    return Nanoseconds::zero();
}

Nanoseconds UsbTrackerDriver::lose(UsbTrackerState state) {
    report(state);
    tell(PacketKind::Closed, clock_());
    std::erase(failed_, place_);
    if (failed_.size() == max_failed) {
        failed_.erase(failed_.begin());
    }
    failed_.push_back(place_);
    counts_ = counts();
    transport_->close();
    transport_.reset();
    session_.reset();
    return between_searches;
}

Nanoseconds UsbTrackerDriver::step(std::vector<PoseSample>& samples) {
    if (!transport_) {
        return search();
    }
    const MonotonicTime before = clock_();
    if (const std::span<const std::byte> command = session_->due(before); !command.empty()) {
        tell(PacketKind::Sent, before, command);
        if (!transport_->write(command, write_timeout)) {
            return lose(UsbTrackerState::NotConnected);
        }
    }
    if (session_->failed()) {
        return lose(session_->state(clock_()));
    }
    const Result<std::size_t> count = transport_->read(buffer_, read_timeout);
    if (!count) {
        return lose(UsbTrackerState::NotConnected);
    }
    const MonotonicTime now = clock_();
    const std::span<const std::byte> bytes = std::span(buffer_).first(*count);
    tell(PacketKind::Received, now, bytes);
    session_->receive(bytes, now, samples);
    report(session_->state(now));
    return Nanoseconds::zero();
}

TrackerCounts UsbTrackerDriver::counts() const {
    TrackerCounts counts = counts_;
    if (session_) {
        counts += session_->intake().counts();
    }
    return counts;
}

} // namespace frustumscreen::tracker
