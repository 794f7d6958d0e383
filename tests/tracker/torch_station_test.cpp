// The torch's sensor at the tracker: a station beside the prop's and the head's, which is no reason for a fault.
#include "firmware_host/tracker/sequence_checker.h"

#include <gtest/gtest.h>

namespace frustumscreen::tracker {
namespace {

constexpr double tick_ns = 1e6;

DeviceFrame frame_of(std::uint32_t counter, std::size_t sensors) {
    DeviceFrame frame;
    frame.counter = counter;
    frame.tick = 10 * counter;
    frame.count = sensors;
    for (std::size_t k = 0; k < sensors; ++k) {
        frame.sensors.at(k).sensor = static_cast<int>(k) + 1;
        frame.sensors.at(k).position_m = {0.1 * static_cast<double>(k + 1), 0.0, 0.2};
        frame.sensors.at(k).usable = true;
    }
    return frame;
}

/// Takes frames for three seconds; `change` is made to each.
template <typename Change>
UsbTrackerState after(SequenceChecker& checker, std::vector<PoseSample>& samples, const Change& change) {
    MonotonicTime now{};
    for (std::uint32_t k = 0; k < 300; ++k) {
        now += std::chrono::milliseconds(10);
        DeviceFrame frame = frame_of(k, 3);
        change(frame);
        EXPECT_TRUE(checker.take(frame, now, samples));
    }
    return checker.state(now);
}

TEST(TorchStation, IsReportedBesideTheOtherStations) {
    SequenceChecker checker(tick_ns);
    std::vector<PoseSample> samples;
    EXPECT_EQ(after(checker, samples, [](DeviceFrame&) {}), UsbTrackerState::Streaming);
    ASSERT_EQ(samples.size(), 900U);
    EXPECT_EQ(samples[2].station, torch_station);
    EXPECT_EQ(samples[2].position_m.x, 0.1 * 3.0);
}

TEST(TorchStation, MissingSensorIsNoFault) {
    SequenceChecker checker(tick_ns);
    std::vector<PoseSample> samples;
    EXPECT_EQ(after(checker, samples,
                    [](DeviceFrame& frame) {
                        frame.sensors[2].usable = false;
                        frame.sensors[2].present = false;
                    }),
              UsbTrackerState::Streaming);
    EXPECT_FALSE(samples[2].ok);
}

/// Visitors are told to keep the prop away from metal; metal near the torch moves no artifact.
TEST(TorchStation, IgnoresMetalNearTheTorch) {
    for (const std::size_t sensor : {0U, 1U, 2U}) {
        SequenceChecker checker(tick_ns);
        std::vector<PoseSample> samples;
        EXPECT_EQ(
            after(checker, samples, [&](DeviceFrame& frame) { frame.sensors.at(sensor).distortion = 255; }),
            sensor < 2 ? UsbTrackerState::MetalNear : UsbTrackerState::Streaming);
    }
}

} // namespace
} // namespace frustumscreen::tracker
