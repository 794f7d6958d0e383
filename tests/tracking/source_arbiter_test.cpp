#include "app/tracking/source_arbiter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::tracking {
namespace {

using std::chrono::milliseconds;

constexpr double lever_m = 0.06;

/// A source at x, with this standard deviation and age.
SourcePose source(double x_m, double sd_m, milliseconds age = milliseconds(20)) {
    SourcePose one;
    one.estimate = {{{1.0, 0.0, 0.0, 0.0}, {x_m, 0.0, 0.0}}, PoseStatus::Predicted, age, 1};
    one.estimate.status = age > milliseconds(1000) ? PoseStatus::Stale : PoseStatus::Predicted;
    one.sd_m = sd_m;
    one.lost_after = milliseconds(150);
    return one;
}

MonotonicTime at(int ms) {
    return MonotonicTime(milliseconds(10'000 + ms));
}

/// A source that has never given a pose.
SourcePose never() {
    SourcePose one = source(0.0, 0.0);
    one.estimate.reinitialisations = 0;
    return one;
}

TEST(SourceArbiter, PassesThroughASingleTracker) {
    SourceArbiter source_arbiter;
    for (int ms = 0; ms < 3000; ms += 16) {
        const SourcePose tracker = source(1e-4 * ms, 0.05 + 1e-3 * ms, milliseconds(ms));
        const PoseEstimate shown = source_arbiter.follow(tracker, never(), at(ms));
        EXPECT_EQ(shown.pose.translation, tracker.estimate.pose.translation);
        EXPECT_EQ(shown.status, tracker.estimate.status);
    }
    EXPECT_EQ(source_arbiter.changes(), 0U);
}

TEST(SourceArbiter, DoesNotAlternateBetweenSimilarSources) {
    SourceArbiter source_arbiter;
    for (int ms = 0; ms < 20'000; ms += 16) {
        const double wave = 0.001 * (1.0 + 0.35 * std::sin(0.01 * ms));
        (void)source_arbiter.follow(source(0.0, wave), source(0.005, 0.001), at(ms));
    }
    EXPECT_EQ(source_arbiter.changes(), 0U);
    EXPECT_EQ(source_arbiter.leader(), Source::Tracker);
}

TEST(SourceArbiter, ChangesAfterHalfASecondOfClearlyLessSpread) {
    SourceArbiter source_arbiter;
    for (int ms = 0; ms < 4000; ms += 10) {
        const bool worse = ms % 1000 < 490 || ms >= 3000; // in bursts that are too short, then permanently
        (void)source_arbiter.follow(source(0.0, worse ? 0.006 : 0.001), source(0.005, 0.0015), at(ms));
        EXPECT_EQ(source_arbiter.leader(), ms < 3500 ? Source::Tracker : Source::Tags) << ms;
    }
}

/// For any disagreement nothing jumps, and the pose ends at the new leader.
TEST(SourceArbiter, ADisagreementFadesAtABoundedRate) {
    for (const double off_m : {0.001, 0.005, 0.02, 0.1}) {
        SourceArbiter source_arbiter;
        constexpr int step_ms = 16;
        double before = 0.0;
        double fastest = 0.0;
        (void)source_arbiter.follow(source(0.0, 0.001), source(off_m, 0.0015), at(0));
        double shown = 0.0;
        for (int ms = step_ms; ms < 1500; ms += step_ms) {
            const SourcePose tracker = source(0.0, 0.001, milliseconds(200));
            shown = source_arbiter.follow(tracker, source(off_m, 0.0015), at(ms)).pose.translation.x;
            fastest = std::fmax(fastest, std::fabs(shown - before) / (1e-3 * step_ms));
            before = shown;
        }
        EXPECT_EQ(source_arbiter.leader(), Source::Tags);
        EXPECT_EQ(shown, off_m);
        EXPECT_LE(fastest, std::fmax(0.02, 1.5 * off_m) * 1.0001) << off_m;
    }
}

/// A change back in the middle of a fade does not jump either.
TEST(SourceArbiter, AChangeDuringAFadeDoesNotJump) {
    SourceArbiter source_arbiter;
    (void)source_arbiter.follow(source(0.0, 0.001), source(0.01, 0.0015), at(0));
    double before = 0.0;
    for (int ms = 10; ms < 3000; ms += 10) {
        const bool lost = ms < 300 || (ms >= 900 && ms < 1100);
        const milliseconds age(lost ? 200 : 20);
        const double shown =
            source_arbiter.follow(source(0.0, 0.0007, age), source(0.01, 0.0015), at(ms)).pose.translation.x;
        EXPECT_LE(std::fabs(shown - before), 0.02 * 0.0101) << ms;
        before = shown;
    }
    EXPECT_EQ(source_arbiter.leader(), Source::Tracker);
    EXPECT_EQ(before, 0.0);
    EXPECT_EQ(source_arbiter.changes(), 4U);
}

/// The fade is a function of time: thirty pictures per second show the same poses as two hundred at equal
/// times.
TEST(SourceArbiter, TheFadeDoesNotDependOnTheFrameRate) {
    SourceArbiter slow;
    SourceArbiter fast;
    for (SourceArbiter* one : {&slow, &fast}) {
        (void)one->follow(source(0.0, 0.001), source(0.008, 0.0015), at(0));
        (void)one->follow(source(0.0, 0.001, milliseconds(200)), source(0.008, 0.0015), at(40));
    }
    for (int ms = 45; ms < 1500; ms += 5) {
        const SourcePose tracker = source(0.0, 0.001, milliseconds(200));
        const PoseEstimate often = fast.follow(tracker, source(0.008, 0.0015), at(ms));
        if (ms % 35 == 0) {
            EXPECT_EQ(slow.follow(tracker, source(0.008, 0.0015), at(ms)).pose.translation,
                      often.pose.translation);
        }
    }
}

TEST(SourceArbiter, RestartsAfterAStalePose) {
    SourceArbiter source_arbiter;
    const PoseEstimate before = source_arbiter.follow(source(0.0, 0.001), never(), at(0));
    (void)source_arbiter.follow(source(0.0, 0.001, milliseconds(2000)), never(), at(2000));
    const PoseEstimate found =
        source_arbiter.follow(source(0.0, 0.001, milliseconds(2016)), source(0.2, 0.0015), at(2016));
    EXPECT_EQ(found.pose.translation.x, 0.2);
    EXPECT_GT(found.reinitialisations, before.reinitialisations);
}

TEST(SourceArbiter, TimeThatGoesBackDoesNotChangeTheLeader) {
    SourceArbiter source_arbiter;
    for (int ms = 5000; ms > 0; ms -= 10) {
        (void)source_arbiter.follow(source(0.0, 0.006), source(0.0, 0.001), at(ms));
    }
    EXPECT_EQ(source_arbiter.changes(), 0U);
}

} // namespace
} // namespace frustumscreen::tracking
