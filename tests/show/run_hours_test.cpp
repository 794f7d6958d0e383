// The exhibit's hours in a run, with both clocks simulated.

#include "app/show/run_hours.h"

#include <gtest/gtest.h>

namespace frustumscreen::show {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;
using std::chrono::sys_days;

std::chrono::seconds no_offset(std::chrono::sys_seconds /*time*/) {
    return seconds(0);
}

settings::HoursSettings from_ten_to_six() {
    settings::HoursSettings settings;
    settings.weekdays.fill({{600, 1080}});
    return settings;
}

/// Both clocks advance together, unless the wall clock is set.
struct Kiosk {
    explicit Kiosk(const settings::HoursSettings& settings = from_ten_to_six(),
                   std::string_view missing_zone = {})
        : run(settings, no_offset, missing_zone) {}

    void live(Nanoseconds length) {
        for (const MonotonicTime end = now + length; now < end; now += std::chrono::milliseconds(100)) {
            run.step(now, {std::chrono::time_point_cast<std::chrono::system_clock::duration>(wall), pressed,
                           std::nullopt, true});
            pressed = false;
            wall += std::chrono::milliseconds(100);
        }
    }
    [[nodiscard]] std::string why() const { return std::string(run.status().why.view()); }

    RunHours run;
    MonotonicTime now{hours(1)};
    std::chrono::sys_time<Nanoseconds> wall{sys_days(std::chrono::year(2026) / 11 / 23) + hours(12)};
    bool pressed = false;
};

TEST(RunHours, SleepsAndWakesByTheTimetable) {
    Kiosk kiosk;
    kiosk.live(minutes(1));
    EXPECT_EQ(kiosk.run.status().state, "open");
    EXPECT_EQ(kiosk.run.status().until, sys_days(std::chrono::year(2026) / 11 / 23) + hours(18));
    EXPECT_EQ(kiosk.run.light(), 1.0);
    kiosk.live(hours(6));
    EXPECT_TRUE(kiosk.run.asleep());
    EXPECT_TRUE(kiosk.run.status().asleep);
    EXPECT_EQ(kiosk.run.status().state, "closed");
    EXPECT_EQ(kiosk.run.status().until, sys_days(std::chrono::year(2026) / 11 / 24) + hours(10));
    EXPECT_NE(kiosk.why().find("asleep"), std::string::npos) << kiosk.why();
    EXPECT_TRUE(kiosk.run.status().clock.view().empty());
    kiosk.live(hours(16));
    EXPECT_FALSE(kiosk.run.asleep());
    EXPECT_EQ(kiosk.run.light(), 1.0);
}

TEST(RunHours, AButtonPressWakesTheExhibit) {
    Kiosk kiosk;
    kiosk.live(hours(7));
    ASSERT_TRUE(kiosk.run.asleep());
    kiosk.pressed = true;
    kiosk.live(seconds(1));
    EXPECT_EQ(kiosk.run.light(), 1.0);
    EXPECT_NE(kiosk.why().find("but a button was pressed"), std::string::npos) << kiosk.why();
    kiosk.live(minutes(11));
    EXPECT_TRUE(kiosk.run.asleep());
}

TEST(RunHours, AnUnsetClockKeepsTheExhibitAwake) {
    Kiosk kiosk;
    kiosk.wall = sys_days(std::chrono::year(1970) / 1 / 1) + hours(3);
    kiosk.live(hours(30));
    EXPECT_EQ(kiosk.run.light(), 1.0);
    EXPECT_EQ(kiosk.run.status().state, "clock_wrong");
    EXPECT_FALSE(kiosk.run.status().until);
    EXPECT_NE(kiosk.why().find("was never set"), std::string::npos) << kiosk.why();
    kiosk.wall = sys_days(std::chrono::year(2026) / 11 / 23) + hours(3);
    kiosk.live(minutes(1));
    EXPECT_TRUE(kiosk.run.asleep());
    EXPECT_NE(kiosk.run.status().clock.view().find("set forward"), std::string::npos);
}

TEST(RunHours, AClockJumpShiftsTheTimetableAndIsReported) {
    Kiosk kiosk;
    kiosk.live(hours(7));
    ASSERT_TRUE(kiosk.run.asleep());
    kiosk.pressed = true;
    kiosk.live(minutes(5));
    kiosk.wall += hours(2);
    kiosk.live(minutes(4));
    EXPECT_EQ(kiosk.run.light(), 1.0) << "ten minutes are ten minutes";
    EXPECT_NE(kiosk.run.status().clock.view().find("set forward by 7200 s"), std::string::npos)
        << kiosk.run.status().clock.view();
    kiosk.live(minutes(2));
    ASSERT_TRUE(kiosk.run.asleep());
    kiosk.wall -= hours(9);
    kiosk.live(seconds(2));
    EXPECT_EQ(kiosk.run.status().state, "open");
    EXPECT_EQ(kiosk.run.light(), 1.0);
}

TEST(RunHours, ReportsAMissingTimeZone) {
    Kiosk kiosk(from_ten_to_six(), "Europe/Nowhere");
    kiosk.live(seconds(1));
    EXPECT_NE(kiosk.why().find("no time zone \"Europe/Nowhere\""), std::string::npos) << kiosk.why();
}

TEST(RunHours, StaysAwakeAndReportsNothingWithoutATimetable) {
    Kiosk kiosk{settings::HoursSettings()};
    kiosk.live(hours(30));
    EXPECT_EQ(kiosk.run.light(), 1.0);
    EXPECT_EQ(kiosk.run.status().state, "always");
    EXPECT_EQ(kiosk.why(), "");
}

} // namespace
} // namespace frustumscreen::show
