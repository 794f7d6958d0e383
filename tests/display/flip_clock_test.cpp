#include "firmware_host/display/flip_clock.h"

#include <gtest/gtest.h>

namespace frustumscreen::display {
namespace {

MonotonicTime at_us(std::int64_t us) {
    return from_microseconds(us);
}

TEST(FlipClock, HasNoGridBeforeTheFirstFlip) {
    const FlipClock clock(100.0);
    EXPECT_FALSE(clock.known());
    EXPECT_EQ(clock.first_after(at_us(5)), at_us(5));
    EXPECT_EQ(clock.next_frame(at_us(5), Nanoseconds(7000)), at_us(12));
}

TEST(FlipClock, TheFirstRefreshAfterATimeIsLaterThanIt) {
    FlipClock clock(100.0); // every 10 ms
    clock.flipped(at_us(1'000'000));
    EXPECT_EQ(clock.first_after(at_us(1'000'000)), at_us(1'010'000));
    EXPECT_EQ(clock.first_after(at_us(1'009'999)), at_us(1'010'000));
    EXPECT_EQ(clock.first_after(at_us(1'010'000)), at_us(1'020'000));
    EXPECT_EQ(clock.first_after(at_us(2'345'678)), at_us(2'350'000));
    EXPECT_EQ(clock.first_after(at_us(999'000)), at_us(1'000'000));
    EXPECT_EQ(clock.first_after(at_us(985'000)), at_us(990'000));
}

TEST(FlipClock, FramesBeginOnRefreshesDespiteJitter) {
    FlipClock clock(100.0);
    MonotonicTime frame = at_us(1'000'000);
    clock.flipped(frame);
    for (int k = 0; k < 1000; ++k) {
        const MonotonicTime next = clock.next_frame(frame, std::chrono::milliseconds(10));
        EXPECT_LT(std::chrono::abs(next - frame - std::chrono::milliseconds(10)),
                  std::chrono::microseconds(300));
        clock.flipped(next + std::chrono::microseconds((k * 37) % 200 - 100));
        frame = next;
    }
}

TEST(FlipClock, ASlowerExhibitSkipsRefreshes) {
    FlipClock clock(60.0);
    clock.flipped(at_us(0));
    EXPECT_NEAR(to_seconds(clock.next_frame(at_us(0), Nanoseconds(33'333'333)).time_since_epoch()),
                2.0 / 60.0, 1e-6);
    EXPECT_NEAR(to_seconds(clock.next_frame(at_us(0), Nanoseconds(10'000'000)).time_since_epoch()),
                1.0 / 60.0, 1e-6)
        << "no faster than the projector";
}

} // namespace
} // namespace frustumscreen::display
