/// The driver with a fake tracker, on the fake's clock.
#pragma once

#include "firmware_host/tracker/usb_tracker_driver.h"
#include "tests/tracker/fake_usb_tracker.h"

#include <gtest/gtest.h>

namespace frustumscreen::tracker {

/// Whether poses arrive, good or not.
inline bool is_streaming(UsbTrackerState state) {
    return state == UsbTrackerState::Streaming || state == UsbTrackerState::FilterStaysOn ||
           state == UsbTrackerState::SetUpDoubtful || state == UsbTrackerState::SensorMissing ||
           state == UsbTrackerState::PosesUnusable || state == UsbTrackerState::PosesLate ||
           state == UsbTrackerState::MetalNear;
}

class Bench {
public:
    explicit Bench(UsbTrackerModel model)
        : driver_(std::make_unique<FakeBus>(device), {}, [this] { return device.now; }) {
        device.model = model;
    }

    /// Runs for `length`; received poses are in `samples`, checked against the sent ones.
    void run(Nanoseconds length) {
        const MonotonicTime end = device.now + length;
        while (device.now < end) {
            step();
        }
    }
    /// Runs until it streams; returns how long that took, or nullopt after `longest`.
    std::optional<Nanoseconds> until_streaming(Nanoseconds longest) {
        const MonotonicTime start = device.now;
        while (device.now - start < longest) {
            step();
            if (is_streaming(state())) {
                return device.now - start;
            }
        }
        return std::nullopt;
    }
    [[nodiscard]] UsbTrackerState state() const { return driver_.state(); }
    [[nodiscard]] TrackerCounts counts() const { return driver_.counts(); }

    FakeUsbTracker device;
    std::vector<PoseSample> samples;

private:
    void step() {
        const std::size_t before = samples.size();
        device.now += driver_.step(samples);
        for (std::size_t k = before; k < samples.size(); ++k) {
            EXPECT_TRUE(!samples[k].ok || device.was_sent(samples[k]));
            EXPECT_LE(samples[k].time, device.now);
            EXPECT_TRUE(k == 0 || samples[k - 1].time <= samples[k].time);
        }
    }
    UsbTrackerDriver driver_;
};

inline const std::vector<UsbTrackerModel> models{UsbTrackerModel::Viper, UsbTrackerModel::Patriot,
                                                 UsbTrackerModel::Hid};

} // namespace frustumscreen::tracker
