#include "firmware_host/tracker/usb_tracker_driver.h"

#include "firmware_host/tracker/patriot_session.h"
#include "firmware_host/tracker/viper_session.h"

namespace frustumscreen {

UsbTrackerDriver::UsbTrackerDriver(std::unique_ptr<UsbBus> bus, const UsbTrackerSetUp& set_up, Clock clock)
    : bus_(std::move(bus)), set_up_(set_up), clock_(std::move(clock)) {}

/// A device that fails its set-up is set up again and again; what it fails at is worth more than that.
void UsbTrackerDriver::report(UsbTrackerState state) {
    const bool known_trouble = state_ == UsbTrackerState::WrongUnits ||
                               state_ == UsbTrackerState::SetUpRefused || state_ == UsbTrackerState::Silent ||
                               state_ == UsbTrackerState::Booting;
    if (state != UsbTrackerState::SettingUp || !known_trouble) {
        state_ = state;
    }
}

Nanoseconds UsbTrackerDriver::search() {
    tl::expected<FoundTracker, UsbTrackerState> found = bus_->find();
    if (!found) {
        report(found.error());
        return between_searches;
    }
    transport_ = std::move(found->transport);
    if (found->model == UsbTrackerModel::Viper) {
        session_ = std::make_unique<ViperSession>(set_up_);
    } else {
        session_ = std::make_unique<PatriotSession>(set_up_);
    }
    report(UsbTrackerState::SettingUp);
    return Nanoseconds::zero();
}

Nanoseconds UsbTrackerDriver::lose(UsbTrackerState state) {
    report(state);
    transport_->close();
    transport_.reset();
    session_.reset();
    return between_searches;
}

Nanoseconds UsbTrackerDriver::step(std::vector<PoseSample>& samples) {
    if (!transport_) {
        return search();
    }
    if (const std::span<const std::byte> command = session_->due(clock_()); !command.empty()) {
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
    session_->receive(std::span(buffer_).first(*count), now, samples);
    report(session_->state(now));
    return Nanoseconds::zero();
}

IntakeCounts UsbTrackerDriver::counts() const {
    return session_ ? session_->intake().counts() : IntakeCounts{};
}

double UsbTrackerDriver::clock_drift() const {
    return session_ ? session_->intake().clock().drift() : 0.0;
}

} // namespace frustumscreen
