// The tracked state has the prop's pose and the eye's position at any time after the latest sample.
#include "app/tracking/tracked_state.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Tracking) {
    // example
    using std::chrono::milliseconds;
    const MonotonicTime start{};
    tracking::TrackedStateTracker tracker({0.0, -0.55, 0.50}); // the default eye, without a visitor
    tracker::PoseSample sample{start};
    sample.position_m = {0.1, 0.0, 0.0};
    EXPECT_TRUE(tracker.take(sample));

    const tracking::TrackedState soon = tracker.at(start + milliseconds(500));
    EXPECT_TRUE(soon.prop_known && !soon.eye_known());
    EXPECT_EQ(soon.table_from_prop.translation.x, 0.1);
    EXPECT_FALSE(tracker.at(start + milliseconds(1500)).prop_known); // the sample is older than a second
    // end
}

} // namespace
} // namespace frustumscreen::example
