// Windows take one sample a pixel while frames with them miss their deadline.
#include "app/scene/window_samples.h"

#include <gtest/gtest.h>

namespace frustumscreen::scene {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double deadline_ms = 16.0;

/// Runs for a time with frames that take so long with many samples, and so long with few; counts changes.
struct Frames {
    int run(Nanoseconds time, double many_ms, double few_ms, bool shows = true) {
        int changes = 0;
        for (const MonotonicTime end = now + time; now < end;) {
            now += milliseconds(20);
            const bool before = samples.few();
            samples.record(now, before ? few_ms : many_ms, shows);
            changes += samples.few() != before ? 1 : 0;
        }
        return changes;
    }
    WindowSamples samples{deadline_ms};
    MonotonicTime now{seconds(100)};
};

TEST(WindowSamples, StayWhileFramesAreInTime) {
    Frames frames;
    EXPECT_EQ(frames.run(seconds(100), 15.9, 5.0), 0);
    EXPECT_FALSE(frames.samples.few());
}

TEST(WindowSamples, DropAfterMissedDeadlinesAndRecover) {
    Frames frames;
    (void)frames.run(seconds(5), 8.0, 8.0);
    EXPECT_EQ(frames.run(seconds(1), 30.0, 12.0), 1);
    EXPECT_TRUE(frames.samples.few());
    EXPECT_EQ(frames.run(seconds(30), 30.0, 12.0), 0) << "more than the easy share";
    EXPECT_EQ(frames.run(WindowSamples::easy + seconds(2), 8.0, 4.0), 1) << "the windows have become cheaper";
    EXPECT_FALSE(frames.samples.few());
}

TEST(WindowSamples, ASingleLongFrameChangesNothing) {
    Frames frames;
    (void)frames.run(seconds(5), 8.0, 8.0);
    frames.now += milliseconds(20);
    frames.samples.record(frames.now, 60.0, true);
    EXPECT_EQ(frames.run(seconds(5), 8.0, 8.0), 0);
}

TEST(WindowSamples, RetryAtGrowingIntervals) {
    Frames frames;
    const int early = frames.run(seconds(60), 40.0, 4.0);
    EXPECT_GE(early, 5);
    (void)frames.run(seconds(200), 40.0, 4.0);
    EXPECT_LE(frames.run(seconds(240), 40.0, 4.0), 10) << "twice a minute at most";
}

TEST(WindowSamples, IgnoreFramesWithoutWindows) {
    Frames frames;
    EXPECT_EQ(frames.run(seconds(10), 90.0, 90.0, false), 0);
}

} // namespace
} // namespace frustumscreen::scene
