#include "app/tracking/live_tracked_state.h"
#include "app/tracking/motion_filter.h"
#include "app/tracking/shown_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

namespace frustumscreen::tracking {
namespace {

const glm::dvec3 default_eye(0.0, -0.55, 0.5);
constexpr double lever_m = 0.06;

tracker::PoseSample prop_at(std::int64_t t_us, double x_m, double yaw_rad = 0.0) {
    tracker::PoseSample sample;
    sample.time = from_microseconds(t_us);
    sample.position_m = {x_m, 0.0, 0.0};
    sample.rotation = rotation_of({0.0, 0.0, yaw_rad});
    return sample;
}

TEST(LiveTrackedState, StartsWithTheDefaultEyeOnly) {
    LiveTrackedState live(default_eye, lever_m);
    const TrackedState tracked_state = live.at(from_microseconds(7));
    EXPECT_FALSE(tracked_state.prop_known);
    EXPECT_FALSE(tracked_state.head_known);
    EXPECT_EQ(tracked_state.eye_m, default_eye);
}

TEST(LiveTrackedState, RejectsAnInvalidPose) {
    LiveTrackedState live(default_eye, lever_m);
    EXPECT_TRUE(live.take(prop_at(0, 0.1)));
    tracker::PoseSample broken = prop_at(16'000, std::numeric_limits<double>::quiet_NaN());
    EXPECT_FALSE(live.take(broken));
    broken.ok = false;
    EXPECT_TRUE(live.take(broken));
    const TrackedState tracked_state = live.at(from_microseconds(0));
    EXPECT_EQ(tracked_state.table_from_prop.translation, glm::dvec3(0.1, 0.0, 0.0));
    EXPECT_TRUE(tracked_state.prop_known);
}

/// The filter of the hand is not there at all: its poses are those of the table's, bit for bit, also while it is lifted.
TEST(LiveTrackedState, UsesOnlyTheTableFilterForAPropOnTheTable) {
    LiveTrackedState on_table(default_eye, lever_m, {}, PropMotion::OnTable);
    LiveTrackedState in_hand(default_eye, lever_m);
    PoseEstimator table(std::make_unique<MotionFilter>(exhibit_filter()));
    ShownPose shown({.lever_m = lever_m}); // holds what moves by less than can be seen
    int differ = 0;
    for (int k = 0; k < 600; ++k) {
        tracker::PoseSample sample = prop_at(16'000 * k, 0.1 * std::sin(0.03 * k));
        sample.position_m.z = 0.2 + 0.1 * std::sin(0.03 * k); // 0.2 m/s
        on_table.take(sample);
        in_hand.take(sample);
        table.take(sample.time, {sample.rotation, sample.position_m});
        const MonotonicTime lit = from_microseconds(16'000 * k + 33'000);
        const glm::dvec3 place_m = on_table.at(lit).table_from_prop.translation;
        ASSERT_EQ(place_m, shown.follow(table.at(lit), lit).translation) << k;
        differ += place_m != in_hand.at(lit).table_from_prop.translation ? 1 : 0;
    }
    EXPECT_GT(differ, 500) << "otherwise this test sees nothing";
}

/// A picture at rest is not redrawn: the pose must be equal bit for bit.
TEST(LiveTrackedState, RestsWhenThePropRests) {
    LiveTrackedState live(default_eye, lever_m);
    std::int64_t t_us = 0;
    for (; t_us < 500'000; t_us += 16'000) {
        live.take(prop_at(t_us, 3e-7 * static_cast<double>(t_us), 1e-6 * static_cast<double>(t_us)));
        (void)live.at(from_microseconds(t_us + 17'000));
    }
    const double x = 3e-7 * static_cast<double>(t_us);
    const double yaw = 1e-6 * static_cast<double>(t_us);
    std::int64_t settled_us = 0;
    geometry::RigidTransform before;
    const std::int64_t stopped_us = t_us;
    for (; t_us < 4'000'000; t_us += 16'000) {
        live.take(prop_at(t_us, x, yaw));
        const geometry::RigidTransform now = live.at(from_microseconds(t_us + 17'000)).table_from_prop;
        if (now.translation != before.translation || now.rotation != before.rotation) {
            settled_us = t_us;
        }
        before = now;
    }
    EXPECT_LT(settled_us - stopped_us, 1'000'000);
    EXPECT_LT(slip_m(step_between({rotation_of({0.0, 0.0, yaw}), {x, 0.0, 0.0}}, before), lever_m), 0.000051);
}

TEST(LiveTrackedState, HoldsThePropInADropoutAndReturnsWithoutAJump) {
    LiveTrackedState live(default_eye, lever_m);
    constexpr std::int64_t period_us = 16'667;
    constexpr int lost = 60;
    constexpr int back = 200;
    geometry::RigidTransform before;
    double largest_m = 0.0;
    int first_unknown = 0;
    for (int k = 0; k < 400; ++k) {
        if (k < lost || k >= back) {
            live.take(prop_at(k * period_us, k < lost ? 0.0 : 0.1, k < lost ? 0.0 : 1.0));
        }
        const TrackedState now = live.at(from_microseconds(k * period_us + 17'000));
        if (k > 0) {
            largest_m = std::fmax(largest_m, slip_m(step_between(before, now.table_from_prop), lever_m));
        }
        if (k >= lost && k < back) {
            EXPECT_LT(slip_m(step_between({}, now.table_from_prop), lever_m), 1e-4) << "not held";
        }
        if (!now.prop_known && first_unknown == 0) {
            first_unknown = k;
        }
        EXPECT_TRUE(now.prop_known || (k > lost && k < back)) << k;
        before = now.table_from_prop;
    }
    EXPECT_NEAR(first_unknown, lost + 60, 2); // one second
    // 0.16 m at the prop within 0.25 s along a smooth step: at most 1.5 times the mean speed.
    EXPECT_LT(largest_m, 1.5 * 0.16 / 0.25 * 0.0167 * 1.1);
    EXPECT_LT(slip_m(step_between({rotation_of({0.0, 0.0, 1.0}), {0.1, 0.0, 0.0}}, before), lever_m), 0.0001);
}

/// The eye through a loss and a return; the loss is shorter or longer than the glide.
TEST(LiveTrackedState, TheEyeDoesNotJumpWhenTheHeadIsLostAndFound) {
    constexpr std::int64_t period_us = 16'667;
    constexpr int lost = 60;
    const glm::dvec3 before_loss(0.3, -0.5, 0.45);
    const glm::dvec3 after_return(-0.1, -0.6, 0.6);
    for (const int back : {lost + 65, lost + 69, lost + 200}) { // stale after 60; two return during the
                                                                // glide, one after it
        LiveTrackedState live(default_eye, lever_m);
        glm::dvec3 eye = live.at(from_microseconds(0)).eye_m;
        EXPECT_EQ(eye, default_eye);
        double largest_m = 0.0;
        for (int k = 0; k < 400; ++k) {
            if (k < lost || k >= back) {
                tracker::PoseSample head;
                head.time = from_microseconds(k * period_us);
                head.station = tracker::head_station;
                head.position_m = k < lost ? before_loss : after_return;
                EXPECT_TRUE(live.take(head));
            }
            const TrackedState now = live.at(from_microseconds(k * period_us + 17'000));
            largest_m = std::fmax(largest_m, glm::length(now.eye_m - eye));
            eye = now.eye_m;
            if (k > 30 && k < lost + 50) {
                EXPECT_LT(glm::length(eye - before_loss), 0.0001) << k;
                EXPECT_TRUE(now.head_known);
            }
            if (k > lost + 80 && k < back) {
                EXPECT_LT(glm::length(eye - default_eye), 0.0001) << k;
                EXPECT_FALSE(now.head_known);
            }
        }
        EXPECT_LT(glm::length(eye - after_return), 0.0001);
        // The longest way within 0.25 s along a smooth step: at most 1.5 times the mean speed.
        const double longest_m =
            std::fmax(glm::length(after_return - before_loss), glm::length(default_eye - before_loss));
        EXPECT_LT(largest_m, 1.5 * longest_m / 0.25 * 0.0167 * 1.1) << back;
    }
}

/// A fixed viewer's eye, and the eye before the first head sample, is the default one bit for bit.
TEST(LiveTrackedState, TheEyeStaysAtTheDefaultWithoutAHead) {
    LiveTrackedState live(default_eye, lever_m);
    for (std::int64_t t_us = 0; t_us < 2'000'000; t_us += 16'667) {
        live.take(prop_at(t_us, 0.1));
        const TrackedState now = live.at(from_microseconds(t_us + 17'000));
        EXPECT_EQ(now.eye_m, default_eye);
        EXPECT_FALSE(now.head_known);
    }
}

TEST(LightDelay, FollowsTheFlipsAndBoundsImpossibleOnes) {
    LightDelay delay(std::chrono::milliseconds(17));
    EXPECT_EQ(delay.from_now(), std::chrono::milliseconds(17));
    MonotonicTime now = from_microseconds(1'000'000);
    const auto flips = [&](int frames, Nanoseconds after) {
        for (int k = 0; k < frames; ++k) {
            delay.flipped(now, now + after);
            now += std::chrono::milliseconds(16);
        }
    };
    flips(1, std::chrono::milliseconds(30));
    EXPECT_NEAR(to_seconds(delay.from_now()), 0.047, 1e-9); // the first measurement counts in full
    flips(200, std::chrono::milliseconds(8));
    EXPECT_NEAR(to_seconds(delay.from_now()), 0.025, 1e-6);
    flips(200, -std::chrono::hours(1));
    EXPECT_NEAR(to_seconds(delay.from_now()), 0.017, 1e-6);
    flips(1, std::chrono::hours(1));
    EXPECT_LE(to_seconds(delay.from_now()), 0.017 + 0.0101);
    const Nanoseconds before = delay.from_now();
    delay.flipped(now - std::chrono::hours(1), now); // time goes back
    EXPECT_EQ(delay.from_now(), before);
}

TEST(LightDelay, DoesNotDependOnTheFrameRate) {
    constexpr double interval_s = 0.24;
    for (const int frames : {1, 3, 24, 240, 24'000}) {
        LightDelay delay(Nanoseconds(0));
        MonotonicTime now = from_microseconds(1'000'000);
        delay.flipped(now, now + std::chrono::milliseconds(8));
        for (int k = 0; k < frames; ++k) {
            now += Nanoseconds(240'000'000 / frames);
            delay.flipped(now, now + std::chrono::milliseconds(33));
        }
        const double exact_s = 0.033 - 0.025 * std::exp(-interval_s / LightDelay::time_constant_s);
        EXPECT_NEAR(to_seconds(delay.from_now()), exact_s, 2e-9) << frames;
    }
}

} // namespace
} // namespace frustumscreen::tracking
