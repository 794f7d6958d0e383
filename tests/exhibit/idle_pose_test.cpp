#include "app/exhibit/idle_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const MonotonicTime start{seconds(100)};
const geometry::RigidTransform held_pose{{1.0, 0.0, 0.0, 0.0}, {0.2, -0.1, 0.0}};
constexpr glm::dvec2 place_m{0.03, 0.01};

/// A tracker that gives a good pose in every frame until `lost`, and again from `found` on; the pose counts as known
/// for a second after the last good one.
struct Visit {
    MonotonicTime lost;
    MonotonicTime found = lost + seconds(10'000);
    IdlePose idle_pose{place_m, true, start};

    [[nodiscard]] DrawnPose at(MonotonicTime now) {
        const Nanoseconds age = now >= lost && now < found ? Nanoseconds(now - lost) : Nanoseconds(0);
        return idle_pose.at(now, age <= seconds(1), age, held_pose);
    }
};

TEST(IdlePose, HoldsAShortDropoutWithoutAnybodyNoticing) {
    Visit visit{start + seconds(1), start + seconds(3) - milliseconds(1)};
    for (MonotonicTime now = start; now < start + seconds(10); now += milliseconds(16)) {
        const DrawnPose drawn = visit.at(now);
        EXPECT_EQ(drawn.brightness, 1.0);
        EXPECT_FALSE(drawn.changing);
        EXPECT_FALSE(drawn.attracts);
        EXPECT_EQ(drawn.table_from_prop.translation, held_pose.translation);
    }
}

TEST(IdlePose, FadesCalmlyToThePictureThatTurnsAndMovesOnlyInTheDark) {
    Visit visit{start + seconds(1)};
    double before = 1.0;
    bool attracted = false;
    double darkest = 1.0;
    for (MonotonicTime now = start; now < start + seconds(20); now += milliseconds(1)) {
        const DrawnPose drawn = visit.at(now);
        EXPECT_NEAR(drawn.brightness, before, 0.0026); // 1.5 / 600 ms
        if (drawn.attracts != attracted) {
            EXPECT_LT(drawn.brightness, 1e-4);
            EXPECT_GE(now, start + seconds(3) + milliseconds(599));
            attracted = drawn.attracts;
        }
        darkest = std::fmin(darkest, drawn.brightness);
        before = drawn.brightness;
    }
    EXPECT_TRUE(attracted);
    EXPECT_LT(darkest, 1e-4);
    EXPECT_EQ(before, 1.0);
}

TEST(IdlePose, TurnsOnceInFortySecondsAtItsPlace) {
    Visit visit{start + seconds(1)};
    for (int s = 5; s < 120; ++s) {
        const DrawnPose drawn = visit.at(start + seconds(s));
        EXPECT_EQ(drawn.table_from_prop.translation, glm::dvec3(place_m, 0.0));
        const double angle = 2.0 * std::numbers::pi * (s - 3) / 40.0; // since the fade began
        const glm::dvec3 ahead = drawn.table_from_prop.direction({1.0, 0.0, 0.0});
        EXPECT_NEAR(ahead.x, std::cos(angle), 1e-9) << s;
        EXPECT_NEAR(ahead.y, std::sin(angle), 1e-9) << s;
    }
}

TEST(IdlePose, AReturnAtAnyMomentOfTheFadeNeverJumps) {
    for (int ms = 1000; ms < 5000; ms += 13) {
        Visit visit{start + seconds(1), start + seconds(1) + milliseconds(ms)};
        double before = 1.0;
        bool attracted = false;
        for (MonotonicTime now = start; now < visit.found + seconds(3); now += milliseconds(1)) {
            const DrawnPose drawn = visit.at(now);
            ASSERT_NEAR(drawn.brightness, before, 0.0026) << ms;
            ASSERT_TRUE(drawn.attracts == attracted || drawn.brightness < 1e-4) << ms;
            attracted = drawn.attracts;
            before = drawn.brightness;
        }
        EXPECT_FALSE(attracted);
        EXPECT_EQ(before, 1.0);
    }
}

TEST(IdlePose, LooksTheSameAtAnyRhythmOfFrames) {
    const auto stand_at = [](MonotonicTime end, Nanoseconds step) {
        Visit visit{start + seconds(1)};
        for (MonotonicTime now = start; now < end; now += step) {
            (void)visit.at(now);
        }
        return visit.at(end);
    };
    for (int ms = 2900; ms < 6000; ms += 50) {
        const MonotonicTime end = start + milliseconds(ms);
        const DrawnPose often = stand_at(end, milliseconds(1));
        const DrawnPose rarely = stand_at(end, seconds(2));
        EXPECT_EQ(often.brightness, rarely.brightness) << ms;
        EXPECT_EQ(often.table_from_prop.rotation, rarely.table_from_prop.rotation) << ms;
    }
}

TEST(IdlePose, WithoutAnyPoseYetItTurnsAtOnceAndGivesWayToTheFirst) {
    IdlePose idle_pose(place_m, false, start);
    const DrawnPose first = idle_pose.at(start, false, Nanoseconds(0), {});
    EXPECT_TRUE(first.attracts);
    EXPECT_EQ(first.brightness, 1.0);
    EXPECT_TRUE(idle_pose.at(start + seconds(5), false, Nanoseconds(0), {}).attracts);
    (void)idle_pose.at(start + seconds(6), true, Nanoseconds(0), held_pose);
    const DrawnPose later = idle_pose.at(start + seconds(8), true, Nanoseconds(0), held_pose);
    EXPECT_FALSE(later.attracts);
    EXPECT_EQ(later.brightness, 1.0);
}

} // namespace
} // namespace frustumscreen::exhibit
