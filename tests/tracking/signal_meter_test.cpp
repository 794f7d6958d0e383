// A meter's figures of a sensor, against noise that was put in.

#include "app/tracking/signal_meter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace frustumscreen::tracking {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const MonotonicTime start{seconds(100)};

/// Samples of `hz` for `length`, with normal noise on each axis of place and turn.
MonotonicTime fill(SignalMeter& meter, double hz, Nanoseconds length, double sd_mm, double sd_deg,
                   int spoilt_every = 0) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    MonotonicTime now = start;
    const Nanoseconds step(static_cast<std::int64_t>(1e9 / hz));
    for (int k = 0; now - start < length; ++k, now += step) {
        const glm::dvec3 off(normal(random), normal(random), normal(random));
        const glm::dvec3 turn(normal(random), normal(random), normal(random));
        const glm::dvec3 half = 0.5 * glm::radians(sd_deg) * turn;
        tracker::PoseSample sample;
        sample.time = now;
        sample.position_m = glm::dvec3(0.3, -0.2, 0.1) + 1e-3 * sd_mm * off;
        sample.rotation =
            glm::normalize(glm::dquat(0.6, 0.0, 0.8, 0.0) * glm::dquat(1.0, half.x, half.y, half.z));
        if (k % 3 == 0) {
            sample.rotation = -sample.rotation; // the same rotation
        }
        sample.ok = spoilt_every == 0 || k % spoilt_every != 0;
        if (!sample.ok) {
            sample.position_m = glm::dvec3(1e3);
        }
        meter.take(sample);
    }
    return now;
}

/// Three axes of `sd` are sqrt(3) of it in all; 240 samples tell it to some 3 %.
TEST(SignalMeter, MeasuresTheAddedNoise) {
    SignalMeter meter;
    const MonotonicTime now = fill(meter, 240.0, seconds(3), 0.1, 0.02);
    const TrackerSignal signal = meter.at(now);
    EXPECT_NEAR(signal.rate_hz, 240.0, 1.5);
    EXPECT_EQ(signal.usable, 1.0);
    ASSERT_TRUE(signal.noise_mm && signal.noise_deg);
    EXPECT_NEAR(*signal.noise_mm, 0.1 * std::sqrt(3.0), 0.1 * 0.1 * std::sqrt(3.0));
    EXPECT_NEAR(*signal.noise_deg, 0.02 * std::sqrt(3.0), 0.1 * 0.02 * std::sqrt(3.0));
}

TEST(SignalMeter, ReportsNoNoiseForAStillSensor) {
    SignalMeter meter;
    const TrackerSignal signal = meter.at(fill(meter, 60.0, seconds(2), 0.0, 0.0));
    EXPECT_NEAR(*signal.noise_mm, 0.0, 1e-9);
    EXPECT_NEAR(*signal.noise_deg, 0.0, 1e-5);
}

TEST(SignalMeter, UnusablePosesAreCountedButNotAsNoise) {
    SignalMeter meter;
    const TrackerSignal signal = meter.at(fill(meter, 100.0, seconds(2), 0.05, 0.01, 4));
    EXPECT_NEAR(signal.rate_hz, 100.0, 1.5);
    EXPECT_NEAR(signal.usable, 0.75, 0.01);
    EXPECT_LT(*signal.noise_mm, 0.15);
}

TEST(SignalMeter, ReportsNoSignalAfterASecondWithoutSamples) {
    SignalMeter meter;
    EXPECT_EQ(meter.at(start), TrackerSignal{});
    const MonotonicTime now = fill(meter, 120.0, seconds(2), 0.1, 0.01);
    EXPECT_GT(meter.at(now + milliseconds(500)).rate_hz, 50.0);
    EXPECT_EQ(meter.at(now + seconds(1)), TrackerSignal{});
}

/// Faster than it has room for: the latest count, and none is counted twice.
TEST(SignalMeter, AFasterTrackerIsLimitedToTheMaxSamples) {
    SignalMeter meter;
    const TrackerSignal signal = meter.at(fill(meter, 2000.0, seconds(2), 0.1, 0.01));
    EXPECT_EQ(signal.rate_hz, static_cast<double>(SignalMeter::max_samples));
}

} // namespace
} // namespace frustumscreen::tracking
