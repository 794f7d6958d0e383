// Every tracker is polled in the same way. This one simulates a visitor and needs no device.
#include "firmware_host/tracker/simulated_tracker.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Tracker) {
    // example
    const MonotonicTime start{};
    tracker::SimulatedTracker tracker(tracker::SimulatedVisitor{},
                                      start); // reports prop and head 120 times a second
    std::vector<tracker::PoseSample> samples;
    ASSERT_TRUE(tracker.poll(start + std::chrono::seconds(1), samples));
    EXPECT_EQ(samples.size(), 2U * 121U); // from 0 s to 1 s, both included
    EXPECT_EQ(samples[0].station, tracker::prop_station);
    EXPECT_EQ(samples[0].position_m.z, 0.0); // the prop stands on the table
    // end
}

} // namespace
} // namespace frustumscreen::example
