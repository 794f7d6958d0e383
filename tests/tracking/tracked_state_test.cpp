#include "app/tracking/tracked_state.h"

#include <gtest/gtest.h>

namespace frustumscreen::tracking {
namespace {

const glm::dvec3 default_eye(0.0, -0.55, 0.5);

tracker::PoseSample sample_at(std::int64_t t_us, int station, const glm::dvec3& position, bool ok = true) {
    tracker::PoseSample sample;
    sample.time = from_microseconds(t_us);
    sample.station = station;
    sample.position_m = position;
    sample.ok = ok;
    return sample;
}

TEST(TrackedState, StartsWithTheDefaultEyeOnly) {
    const TrackedStateTracker tracker(default_eye);
    const TrackedState tracked_state = tracker.at(from_microseconds(7));
    EXPECT_FALSE(tracked_state.prop_known);
    EXPECT_FALSE(tracked_state.head_known);
    EXPECT_EQ(tracked_state.eye_m, default_eye);
    EXPECT_EQ(tracked_state.time, from_microseconds(7));
}

TEST(TrackedState, TakesTheLatestPoseOfEachStationAndForgetsItWhenOld) {
    TrackedStateTracker tracker(default_eye, {std::chrono::milliseconds(100), std::chrono::milliseconds(50)});
    tracker.take(sample_at(0, tracker::prop_station, {1, 0, 0}));
    tracker.take(sample_at(10'000, tracker::prop_station, {2, 0, 0}));
    tracker.take(sample_at(10'000, tracker::head_station, {0, -1, 1}));
    const TrackedState fresh = tracker.at(from_microseconds(60'000));
    EXPECT_TRUE(fresh.prop_known);
    EXPECT_EQ(fresh.table_from_prop.translation, glm::dvec3(2, 0, 0));
    EXPECT_EQ(fresh.prop_age, std::chrono::milliseconds(50));
    EXPECT_EQ(fresh.eye_m, glm::dvec3(0, -1, 1));
    const TrackedState headless = tracker.at(from_microseconds(60'001));
    EXPECT_FALSE(headless.head_known);
    EXPECT_EQ(headless.eye_m, default_eye);
    EXPECT_TRUE(headless.prop_known);
    EXPECT_FALSE(tracker.at(from_microseconds(110'001)).prop_known);
}

TEST(TrackedState, UnusableLateAndForeignSamplesChangeNothing) {
    TrackedStateTracker tracker(default_eye);
    tracker.take(sample_at(10, tracker::prop_station, {1, 0, 0}));
    tracker.take(sample_at(20, tracker::prop_station, {9, 0, 0}, false));
    tracker.take(sample_at(5, tracker::prop_station, {9, 0, 0}));
    tracker.take(sample_at(20, tracker::torch_station, {9, 0, 0}));
    EXPECT_EQ(tracker.at(from_microseconds(30)).table_from_prop.translation, glm::dvec3(1, 0, 0));
    EXPECT_EQ(tracker.at(from_microseconds(30)).prop_age, std::chrono::microseconds(20));
}

} // namespace
} // namespace frustumscreen::tracking
