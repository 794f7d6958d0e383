/// Several buses as one. Searches them in order; the first one that opens a tracker wins.
///
/// Threads  one.
#pragma once

#include "firmware_host/tracker/usb_transport.h"

#include <vector>

namespace frustumscreen::tracker {

class CompositeBus final : public UsbBus {
public:
    explicit CompositeBus(std::vector<std::unique_ptr<UsbBus>> buses) : buses_(std::move(buses)) {}

    /// Trouble with a connected device takes precedence over the absence of another one.
    [[nodiscard]] tl::expected<FoundTracker, UsbTrackerState>
    find(std::span<const std::string> but_not) override {
        UsbTrackerState trouble = UsbTrackerState::NotConnected;
        for (const std::unique_ptr<UsbBus>& bus : buses_) {
            tl::expected<FoundTracker, UsbTrackerState> found = bus->find(but_not);
            if (found) {
                return found;
            }
            trouble = trouble == UsbTrackerState::NotConnected ? found.error() : trouble;
        }
        return tl::unexpected(trouble);
    }

private:
    std::vector<std::unique_ptr<UsbBus>> buses_;
};

} // namespace frustumscreen::tracker
