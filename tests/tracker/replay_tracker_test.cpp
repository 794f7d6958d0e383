#include "firmware_host/tracker/replay_tracker.h"

#include <gtest/gtest.h>

namespace frustumscreen::tracker {
namespace {

PoseSample sample_at(std::int64_t t_us, double x, int station = prop_station) {
    PoseSample sample;
    sample.time = from_microseconds(t_us);
    sample.position_m.x = x;
    sample.station = station;
    return sample;
}

TEST(ReplayTracker, ReturnsEachSampleOnceAtItsTime) {
    ReplayTracker tracker({sample_at(1000, 1), sample_at(1000, 2, head_station), sample_at(3000, 3)},
                          from_microseconds(500'000), false);
    std::vector<PoseSample> samples;
    ASSERT_TRUE(tracker.poll(from_microseconds(499'999), samples));
    EXPECT_TRUE(samples.empty());
    ASSERT_TRUE(tracker.poll(from_microseconds(501'999), samples));
    ASSERT_EQ(samples.size(), 2U);
    EXPECT_EQ(samples[0].time, from_microseconds(500'000));
    EXPECT_EQ(samples[1].station, head_station);
    ASSERT_TRUE(tracker.poll(from_microseconds(9'000'000), samples));
    ASSERT_EQ(samples.size(), 3U);
    EXPECT_EQ(samples[2].time, from_microseconds(502'000));
}

TEST(ReplayTracker, PutsAnUnsortedFileInOrder) {
    ReplayTracker tracker({sample_at(20, 2), sample_at(10, 1), sample_at(30, 3)}, from_microseconds(0),
                          false);
    std::vector<PoseSample> samples;
    ASSERT_TRUE(tracker.poll(from_microseconds(1000), samples));
    ASSERT_EQ(samples.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(samples[k].position_m.x, static_cast<double>(k + 1));
    }
}

TEST(ReplayTracker, BeginsAgainOneStepAfterItsEnd) {
    ReplayTracker tracker({sample_at(0, 1), sample_at(10, 2), sample_at(20, 3)}, from_microseconds(0), true);
    std::vector<PoseSample> samples;
    ASSERT_TRUE(tracker.poll(from_microseconds(95), samples));
    ASSERT_EQ(samples.size(), 10U);
    for (std::size_t k = 0; k < 10; ++k) {
        EXPECT_EQ(samples[k].time, from_microseconds(static_cast<std::int64_t>(10 * k)));
        EXPECT_EQ(samples[k].position_m.x, static_cast<double>(k % 3 + 1));
    }
}

TEST(ReplayTracker, RepeatsASinglePoseOnceASecondAndAnEmptyFileNever) {
    ReplayTracker single({sample_at(5, 1)}, from_microseconds(0), true);
    ReplayTracker empty({}, from_microseconds(0), true);
    std::vector<PoseSample> samples;
    ASSERT_TRUE(single.poll(from_microseconds(3'500'000), samples));
    EXPECT_EQ(samples.size(), 4U);
    ASSERT_TRUE(empty.poll(from_microseconds(3'500'000), samples));
    EXPECT_EQ(samples.size(), 4U);
}

TEST(ReplayTracker, PlaysAtAnySpeed) {
    std::vector<PoseSample> recording(11);
    for (std::size_t k = 0; k < recording.size(); ++k) {
        recording[k].time = from_microseconds(500 + 100'000 * static_cast<std::int64_t>(k));
        recording[k].position_m.x = static_cast<double>(k);
    }
    const MonotonicTime start = from_microseconds(7'000'000);
    for (const double speed : {0.25, 4.0}) {
        ReplayTracker tracker(recording, start, false, speed);
        std::vector<PoseSample> samples;
        ASSERT_TRUE(tracker.poll(start + std::chrono::seconds(100), samples));
        ASSERT_EQ(samples.size(), recording.size());
        for (std::size_t k = 0; k < samples.size(); ++k) {
            EXPECT_NEAR(to_seconds(samples[k].time - start), 0.1 * static_cast<double>(k) / speed, 1e-9);
            EXPECT_EQ(samples[k].position_m.x, static_cast<double>(k));
        }
    }
}

} // namespace
} // namespace frustumscreen::tracker
