#include "firmware_host/tracker/device_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace frustumscreen::tracker {
namespace {

/// A device with a drifting clock, seen through transfers that are late, sometimes very late. Computed in
/// long double.
struct Simulation {
    long double tick_ns = 1e9L / 120;
    long double drift = 0.0L; ///< our time per device time, minus 1
    std::uint32_t first_tick = 0;
    long double start_ns = 5e9L;
    bool hiccups = true;

    [[nodiscard]] long double truth_ns(std::int64_t frame) const {
        return start_ns + static_cast<long double>(frame) * tick_ns * (1.0L + drift);
    }
    [[nodiscard]] MonotonicTime arrival(std::int64_t frame, std::mt19937& engine) const {
        long double late_ns = std::exponential_distribution<double>(1.0 / 300'000.0)(engine);
        if (hiccups && frame % 1000 > 985) { // an eighth of a second in which everything is late
            late_ns += 30e6L;
        }
        return MonotonicTime(Nanoseconds(static_cast<Nanoseconds::rep>(truth_ns(frame) + late_ns)));
    }
};

double off_ns(const Simulation& simulation, std::int64_t frame, MonotonicTime time) {
    return static_cast<double>(static_cast<long double>(time.time_since_epoch().count()) -
                               simulation.truth_ns(frame));
}

TEST(DeviceClock, FollowsADriftingClockToATenthOfAMillisecond) {
    for (const long double drift : {0.0L, 80e-6L, -200e-6L, 500e-6L}) {
        Simulation simulation;
        simulation.drift = drift;
        simulation.first_tick = 0xFFFFFF00U; // the counter wraps after two seconds
        DeviceClock clock(static_cast<double>(simulation.tick_ns));
        std::mt19937 engine(1);
        MonotonicTime last{};
        for (std::int64_t frame = 0; frame < 120 * 120; ++frame) {
            const auto tick = static_cast<std::uint32_t>(simulation.first_tick + frame);
            const MonotonicTime time = clock.time_of(tick, simulation.arrival(frame, engine));
            EXPECT_GT(time, last);
            last = time;
            if (frame > 120 * 10) {
                EXPECT_NEAR(off_ns(simulation, frame, time), 0.0, 100'000.0) << "frame " << frame;
            }
        }
        EXPECT_NEAR(clock.drift(), static_cast<double>(drift), 5e-6);
        EXPECT_EQ(clock.restarts(), 0U);
    }
}

TEST(DeviceClock, AMillisecondTimestampIsFollowedToItsOwnResolution) {
    Simulation simulation;
    simulation.tick_ns = 1e9L / 60;
    simulation.drift = 50e-6L;
    DeviceClock clock(1e6);
    std::mt19937 engine(2);
    for (std::int64_t frame = 0; frame < 60 * 60; ++frame) {
        const auto tick = static_cast<std::uint32_t>(
            std::floor(static_cast<long double>(frame) * simulation.tick_ns / 1e6L));
        const MonotonicTime time = clock.time_of(tick, simulation.arrival(frame, engine));
        if (frame > 60 * 10) {
            EXPECT_NEAR(off_ns(simulation, frame, time), 0.0, 1.1e6);
        }
    }
}

TEST(DeviceClock, SameTickGivesTheSameTimeWhenItArrivesLate) {
    DeviceClock clock(1e6);
    const MonotonicTime start = from_microseconds(1'000'000);
    static_cast<void>(clock.time_of(10, start));
    const MonotonicTime time = clock.time_of(27, start + std::chrono::milliseconds(17));
    EXPECT_EQ(clock.time_of(27, start + std::chrono::milliseconds(20)), time);
}

TEST(DeviceClock, DelayedFramesKeepTheirTimes) {
    Simulation simulation;
    simulation.hiccups = false;
    DeviceClock clock(static_cast<double>(simulation.tick_ns));
    std::mt19937 engine(4);
    for (std::int64_t frame = 0; frame < 120 * 20; ++frame) {
        MonotonicTime arrival = simulation.arrival(frame, engine);
        const bool held = frame >= 1500 && frame < 1600; // 0.8 s
        if (held) {
            arrival = simulation.arrival(1600, engine);
        }
        const MonotonicTime time = clock.time_of(static_cast<std::uint32_t>(frame), arrival);
        if (frame > 1200) {
            EXPECT_NEAR(off_ns(simulation, frame, time), 0.0, 100'000.0) << "frame " << frame;
        }
    }
    EXPECT_EQ(clock.restarts(), 0U);
}

TEST(DeviceClock, RestartsAfterAJumpAndTimeStaysMonotonic) {
    for (const std::int64_t jump : {-5000, 100'000}) {
        Simulation simulation;
        DeviceClock clock(static_cast<double>(simulation.tick_ns));
        std::mt19937 engine(5);
        MonotonicTime last{};
        for (std::int64_t frame = 0; frame < 120 * 60; ++frame) {
            const auto tick = static_cast<std::uint32_t>(frame + 10'000 + (frame >= 2400 ? jump : 0));
            const MonotonicTime time = clock.time_of(tick, simulation.arrival(frame, engine));
            EXPECT_GT(time, last);
            last = time;
            if (frame > 2400 + 120) {
                EXPECT_NEAR(off_ns(simulation, frame, time), 0.0, 500'000.0);
            }
        }
        EXPECT_EQ(clock.restarts(), 1U);
    }
}

TEST(DeviceClock, UsesArrivalTimesWhileTheClockRateIsWrong) {
    for (const long double drift : {-0.5L, -0.05L, 0.05L, 1.0L, 3.0L}) {
        Simulation simulation;
        simulation.hiccups = false;
        simulation.drift = drift;
        DeviceClock clock(static_cast<double>(simulation.tick_ns));
        std::mt19937 engine(7);
        std::uint32_t tick = 0;
        MonotonicTime arrival{};
        MonotonicTime last{};
        for (std::int64_t frame = 0; simulation.truth_ns(frame) < 20e9L; ++frame, ++tick) {
            arrival = simulation.arrival(frame, engine);
            const MonotonicTime time = clock.time_of(tick, arrival);
            EXPECT_GT(time, last);
            last = time;
        }
        EXPECT_FALSE(clock.believed());
        EXPECT_EQ(last, arrival);
        const std::uint64_t restarts = clock.restarts();
        simulation.start_ns = static_cast<long double>(arrival.time_since_epoch().count());
        simulation.drift = 0.0L;
        for (std::int64_t frame = 1; frame < 120 * 20; ++frame, ++tick) {
            last = clock.time_of(tick, simulation.arrival(frame, engine));
            if (frame > 120 * 12) {
                EXPECT_TRUE(clock.believed());
                EXPECT_NEAR(off_ns(simulation, frame, last), 0.0, 1e6);
            }
        }
        EXPECT_EQ(clock.restarts(), restarts);
    }
}

TEST(DeviceClock, RecoversAfterTheCounterStoodStill) {
    Simulation simulation;
    simulation.hiccups = false;
    DeviceClock clock(static_cast<double>(simulation.tick_ns));
    std::mt19937 engine(6);
    for (std::int64_t frame = 0; frame < 120 * 20; ++frame) {
        if (frame >= 1200 && frame < 1440) { // two seconds
            continue;
        }
        const std::int64_t counter = frame < 1200 ? frame : frame - 240;
        const MonotonicTime time =
            clock.time_of(static_cast<std::uint32_t>(counter), simulation.arrival(frame, engine));
        if (frame > 1440 + 240) {
            EXPECT_NEAR(off_ns(simulation, frame, time), 0.0, 1e6);
        }
    }
    EXPECT_EQ(clock.restarts(), 1U);
}

} // namespace
} // namespace frustumscreen::tracker
