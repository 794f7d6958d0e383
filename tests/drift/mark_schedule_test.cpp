// Timing of marks: an occasional set while no visitor is present; frames in transition are not used.
#include "app/drift/mark_schedule.h"

#include <gtest/gtest.h>

#include <set>

namespace frustumscreen::drift {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t marks = 4;
constexpr milliseconds frame{20};

TEST(MarkSchedule, StartsASetAfterAQuietTime) {
    MarkSchedule schedule(marks);
    MonotonicTime now{};
    std::optional<MonotonicTime> first;
    std::set<std::size_t> shown;
    for (; now < MonotonicTime(seconds(20)); now += frame) {
        if (const auto mark = schedule.step(now, now >= MonotonicTime(seconds(5)))) {
            first = first.value_or(now);
            shown.insert(mark->mark);
            EXPECT_GT(mark->brightness, 0.0);
            EXPECT_LE(mark->brightness, 1.0);
        }
    }
    ASSERT_TRUE(first);
    EXPECT_NEAR(to_seconds(first->time_since_epoch()),
                5.0 + to_seconds(MarkSchedule::quiet_before + MarkTimes::lead), 0.05);
    EXPECT_EQ(shown, (std::set<std::size_t>{0, 1, 2, 3}));
}

TEST(MarkSchedule, StartsASetEachMinute) {
    MarkSchedule schedule(marks);
    std::set<std::int64_t> sets;
    for (MonotonicTime now{}; now < MonotonicTime(std::chrono::minutes(10)); now += frame) {
        static_cast<void>(schedule.step(now, true));
        if (schedule.began()) {
            sets.insert(schedule.began()->time_since_epoch().count());
        }
    }
    EXPECT_EQ(sets.size(), 10U);
}

TEST(MarkSchedule, EndsASetWhenAVisitorArrives) {
    MarkSchedule schedule(marks);
    MonotonicTime now{};
    while (!schedule.step(now, true)) {
        now += frame;
    }
    EXPECT_TRUE(schedule.began());
    EXPECT_FALSE(schedule.step(now + frame, false));
    EXPECT_FALSE(schedule.began());
    EXPECT_FALSE(schedule.step(now + seconds(10), true)) << "the next one comes a minute later";
}

TEST(MarkTimes, UseFramesOnlyWhileTheLightIsSteady) {
    std::size_t lit = 0, dark = 0, unused = 0;
    for (milliseconds t{0}; t < MarkTimes::length(marks); t += milliseconds(1)) {
        const auto moment = MarkTimes::moment(t, marks);
        if (!moment) {
            ++unused;
            continue;
        }
        const Nanoseconds since_lit =
            t - MarkTimes::lead - static_cast<Nanoseconds::rep>(moment->mark) * MarkTimes::each;
        if (moment->phase == MarkPhase::Lit) {
            ++lit;
            EXPECT_GE(since_lit, MarkTimes::settles);
            EXPECT_LT(since_lit, MarkTimes::lit);
        } else {
            ++dark;
            EXPECT_TRUE(since_lit < Nanoseconds::zero() || since_lit >= MarkTimes::lit + MarkTimes::settles);
        }
    }
    EXPECT_EQ(lit, marks * 300U);
    EXPECT_EQ(dark, marks * 300U + 500U);
    EXPECT_EQ(unused, marks * 400U);
    EXPECT_FALSE(MarkTimes::moment(MarkTimes::length(marks), marks));
    EXPECT_FALSE(MarkTimes::moment(milliseconds(-1), marks));
}

TEST(MarkTimes, FadeMarksInAndOut) {
    EXPECT_EQ(MarkTimes::brightness(milliseconds(0)), 0.0);
    EXPECT_NEAR(MarkTimes::brightness(MarkTimes::fade / 2), 0.5, 1e-9);
    EXPECT_EQ(MarkTimes::brightness(MarkTimes::lit / 2), 1.0);
    EXPECT_EQ(MarkTimes::brightness(MarkTimes::lit), 0.0);
}

} // namespace
} // namespace frustumscreen::drift
