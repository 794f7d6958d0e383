// The timetable, compared with Python's zoneinfo, an independent reader of the same zones; sleep with a simulated
// clock.

#include "app/exhibit/hours.h"
#include "firmware_host/base/local_time.h"
#include "tests/folders.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;
using std::chrono::sys_days;
using std::chrono::sys_seconds;

const std::string script = source_dir() + "/tests/exhibit/opening_times.py";

struct Opened {
    std::int64_t from = 0, to = 0;
    bool operator==(const Opened&) const = default;
};

/// The intervals in which it is open, from querying the timetable from change to change.
std::vector<Opened> openings(const Timetable& timetable, sys_seconds from, sys_seconds to) {
    std::vector<Opened> all;
    while (from < to) {
        const Opening now = timetable.at(from);
        const sys_seconds until = now.until.value_or(to);
        EXPECT_GT(until, from);
        if (now.open) {
            all.push_back({from.time_since_epoch().count(), until.time_since_epoch().count()});
        }
        from = std::max(until, from + seconds(1));
    }
    return all;
}

/// The intervals from Python.
std::vector<Opened> expected(const std::string& zone, const std::string& times, int year, int years) {
    const std::string command = fmt::format("python3 {} {} {} {} {}", script, zone, times, year, years);
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
    std::vector<Opened> all;
    long long from = 0;
    long long to = 0;
    while (pipe && std::fscanf(pipe.get(), "%lld %lld", &from, &to) == 2) {
        all.push_back({from, to});
    }
    return all;
}

settings::HoursSettings every_day(const std::string& times) {
    settings::HoursSettings settings;
    settings::HoursSettings::Day day;
    std::istringstream in(times);
    for (std::string each; std::getline(in, each, ',');) {
        day.push_back(settings::parse_open_span(each).value());
    }
    settings.weekdays.fill(day);
    return settings;
}

struct ZoneCase {
    const char* zone;
    int year, years;
};

class Zones : public testing::TestWithParam<ZoneCase> {};

/// Times before, at, within and after the hour that is skipped or repeated, and over midnight.
TEST_P(Zones, OpeningsMatchPythonsZoneinfo) {
    const auto [zone, year, years] = GetParam();
    if (!use_time_zone(zone)) {
        GTEST_SKIP() << "this machine has no " << zone;
    }
    for (const char* times : {"00:00-02:30", "02:15-02:45", "01:30-03:00", "00:30-01:45,23:30-00:15",
                              "20:00-02:00", "09:00-12:00,13:00-17:30"}) {
        const std::vector<Opened> right = expected(zone, times, year, years);
        ASSERT_GE(right.size(), static_cast<std::size_t>(355 * years));
        const std::vector<Opened> ours =
            openings(Timetable(every_day(times), local_offset_at), sys_seconds(seconds(right.front().from)),
                     sys_seconds(seconds(right.back().to)));
        ASSERT_EQ(ours.size(), right.size()) << times;
        for (std::size_t k = 0; k < right.size(); ++k) {
            ASSERT_EQ(ours[k], right[k]) << times << " " << k << " " << right[k].from;
        }
    }
}

// Lord Howe shifts by half an hour, Santiago and Beirut change at midnight, Casablanca shifts back for Ramadan. Years
// beyond 2037 have no table: they follow the zone's rule.
INSTANTIATE_TEST_SUITE_P(
    Timetable, Zones,
    testing::Values(ZoneCase{"Europe/Berlin", 2026, 2}, ZoneCase{"America/New_York", 2026, 1},
                    ZoneCase{"Australia/Sydney", 2026, 1}, ZoneCase{"Australia/Lord_Howe", 2026, 1},
                    ZoneCase{"America/Santiago", 2026, 1}, ZoneCase{"Asia/Beirut", 2026, 1},
                    ZoneCase{"Africa/Casablanca", 2026, 1}, ZoneCase{"America/Sao_Paulo", 2017, 1},
                    ZoneCase{"Europe/Berlin", 2040, 1}, ZoneCase{"Pacific/Apia", 2012, 1}));

sys_seconds utc(int year, unsigned month, unsigned day, int hour, int minute = 0) {
    return sys_days(std::chrono::year(year) / static_cast<int>(month) / static_cast<int>(day)) + hours(hour) +
           minutes(minute);
}

seconds no_offset(sys_seconds /*time*/) {
    return seconds(0);
}

TEST(Timetable, IsOpenFromOpeningToClosing) {
    const Timetable table(every_day("10:00-18:00"), no_offset);
    EXPECT_EQ(table.at(utc(2026, 11, 23, 10) - seconds(1)), (Opening{false, utc(2026, 11, 23, 10)}));
    EXPECT_EQ(table.at(utc(2026, 11, 23, 10)), (Opening{true, utc(2026, 11, 23, 18)}));
    EXPECT_EQ(table.at(utc(2026, 11, 23, 18) - seconds(1)), (Opening{true, utc(2026, 11, 23, 18)}));
    EXPECT_EQ(table.at(utc(2026, 11, 23, 18)), (Opening{false, utc(2026, 11, 24, 10)}));
}

TEST(Timetable, IsAlwaysOpenWithoutHours) {
    const Timetable table(settings::HoursSettings(), no_offset);
    EXPECT_TRUE(table.always_open());
    EXPECT_EQ(table.at(utc(2026, 1, 1, 0)), (Opening{true, std::nullopt}));
}

TEST(Timetable, IsNeverOpenWithoutAnyDay) {
    settings::HoursSettings settings;
    settings.weekdays.fill({});
    EXPECT_EQ(Timetable(settings, no_offset).at(utc(2026, 1, 1, 0)), (Opening{false, std::nullopt}));
}

TEST(Timetable, JoinsAdjacentAndOverlappingSpans) {
    settings::HoursSettings settings = every_day("00:00-24:00");
    settings.weekdays[6].clear(); // 2026-11-29 is a Sunday
    EXPECT_EQ(Timetable(settings, no_offset).at(utc(2026, 11, 23, 12)),
              (Opening{true, utc(2026, 11, 29, 0)}));
    EXPECT_EQ(Timetable(settings, no_offset).at(utc(2026, 11, 29, 12)),
              (Opening{false, utc(2026, 11, 30, 0)}));
    const Timetable unsorted(every_day("12:00-14:00,09:00-12:00,13:00-15:00"), no_offset);
    EXPECT_EQ(unsorted.at(utc(2026, 11, 23, 9)), (Opening{true, utc(2026, 11, 23, 15)}));
}

TEST(Timetable, ExceptionsReplaceTheWeekday) {
    settings::HoursSettings settings = every_day("20:00-02:00");
    settings.exceptions = {*settings::parse_hours_exception("2026-12-24 10:00-14:00"),
                           *settings::parse_hours_exception("2026-12-24 16:00-17:00"),
                           *settings::parse_hours_exception("2026-12-25 closed")};
    const Timetable table(settings, no_offset);
    EXPECT_EQ(table.at(utc(2026, 12, 24, 1)), (Opening{true, utc(2026, 12, 24, 2)})) << "of the day before";
    EXPECT_EQ(table.at(utc(2026, 12, 24, 2)), (Opening{false, utc(2026, 12, 24, 10)}));
    EXPECT_EQ(table.at(utc(2026, 12, 24, 15)), (Opening{false, utc(2026, 12, 24, 16)}));
    EXPECT_EQ(table.at(utc(2026, 12, 24, 17)), (Opening{false, utc(2026, 12, 26, 20)}));
}

TEST(WallClock, DetectsClockJumps) {
    WallClock clock;
    const auto at = [](int s) { return MonotonicTime(seconds(s)); };
    EXPECT_EQ(clock.look(at(100), utc(2026, 5, 1, 12)), seconds(0));
    EXPECT_EQ(clock.look(at(101), utc(2026, 5, 1, 12) + seconds(1)), seconds(0));
    EXPECT_EQ(clock.look(at(102), utc(2026, 5, 1, 12) + seconds(20)), seconds(0)) << "put right";
    EXPECT_EQ(clock.look(at(103), utc(2026, 5, 1, 13) + seconds(21)), seconds(3600));
    EXPECT_EQ(clock.look(at(104), utc(2026, 5, 1, 13) + seconds(22)), seconds(0)) << "once";
    EXPECT_EQ(clock.look(at(105), utc(2026, 5, 1, 11) + seconds(23)), seconds(-7200));
    EXPECT_FALSE(WallClock::plausible(utc(1970, 1, 1, 0)));
    EXPECT_FALSE(WallClock::plausible(utc(2025, 12, 31, 23, 59)));
    EXPECT_TRUE(WallClock::plausible(utc(2026, 1, 1, 0)));
}

/// An exhibit whose time advances frame by frame.
struct Sleeper {
    Sleep sleep;
    MonotonicTime now{hours(1)};
    Sleep::Input input;
    double darkest_step = 0.0; ///< the largest loss of light between two frames

    void run(Nanoseconds length) {
        for (const MonotonicTime end = now + length; now < end; now += std::chrono::milliseconds(20)) {
            const double before = sleep.light();
            sleep.step(now, input);
            input.pressed = false;
            darkest_step = std::max(darkest_step, before - sleep.light());
        }
    }
    void press() {
        input.pressed = true;
        input.used = now;
    }
};

TEST(Sleep, FadesOutWhenClosedAndUnused) {
    Sleeper exhibit;
    exhibit.run(hours(1));
    EXPECT_EQ(exhibit.sleep.light(), 1.0);
    exhibit.input.open = false;
    exhibit.run(seconds(3));
    EXPECT_LT(exhibit.sleep.light(), 1.0);
    EXPECT_FALSE(exhibit.sleep.asleep());
    exhibit.run(seconds(2));
    EXPECT_TRUE(exhibit.sleep.asleep());
    EXPECT_EQ(exhibit.sleep.light(), 0.0);
    EXPECT_LT(exhibit.darkest_step, 0.01) << "a fade, not a cut";
    exhibit.run(hours(10));
    EXPECT_TRUE(exhibit.sleep.asleep());
    exhibit.input.open = true;
    exhibit.run(seconds(1));
    EXPECT_EQ(exhibit.sleep.light(), 1.0);
}

TEST(Sleep, WaitsForTwoMinutesWithoutUse) {
    Sleeper exhibit;
    exhibit.run(minutes(1));
    exhibit.input.used = exhibit.now;
    exhibit.input.open = false;
    exhibit.run(seconds(119));
    EXPECT_EQ(exhibit.sleep.light(), 1.0);
    exhibit.run(seconds(6));
    EXPECT_TRUE(exhibit.sleep.asleep());
}

TEST(Sleep, WaitsFifteenMinutesAtMost) {
    Sleeper exhibit;
    exhibit.input.open = false;
    for (int minute = 0; minute < 15; ++minute) {
        EXPECT_EQ(exhibit.sleep.light(), 1.0) << minute;
        exhibit.input.used = exhibit.now;
        exhibit.run(minutes(1));
    }
    exhibit.input.used = exhibit.now;
    exhibit.run(seconds(5));
    EXPECT_TRUE(exhibit.sleep.asleep());
    exhibit.input.used = exhibit.now; // the prop moves while the table is cleaned
    exhibit.run(minutes(5));
    EXPECT_TRUE(exhibit.sleep.asleep()) << "a button wakes it, not the prop";
}

TEST(Sleep, ButtonWakesItForTenMinutesAfterTheLastPress) {
    Sleeper exhibit;
    exhibit.input.open = false;
    exhibit.run(minutes(1));
    ASSERT_TRUE(exhibit.sleep.asleep());
    exhibit.press();
    exhibit.run(seconds(1));
    EXPECT_EQ(exhibit.sleep.light(), 1.0) << "well within two seconds";
    exhibit.run(minutes(4));
    exhibit.press();
    exhibit.run(minutes(10) - seconds(1));
    EXPECT_EQ(exhibit.sleep.light(), 1.0);
    exhibit.run(seconds(7));
    EXPECT_TRUE(exhibit.sleep.asleep());
}

TEST(Sleep, PressDuringTheFadeRestoresTheLight) {
    Sleeper exhibit;
    exhibit.input.open = false;
    exhibit.run(seconds(2));
    ASSERT_LT(exhibit.sleep.light(), 1.0);
    ASSERT_FALSE(exhibit.sleep.asleep());
    exhibit.press();
    exhibit.run(seconds(1));
    EXPECT_EQ(exhibit.sleep.light(), 1.0);
}

TEST(Sleep, StaysAwakeUntilSleepIsAllowed) {
    Sleeper exhibit;
    exhibit.input.open = false;
    exhibit.input.may_sleep = false;
    exhibit.run(hours(1));
    EXPECT_EQ(exhibit.sleep.light(), 1.0);
    exhibit.input.may_sleep = true;
    exhibit.run(seconds(5));
    EXPECT_TRUE(exhibit.sleep.asleep());
}

} // namespace
} // namespace frustumscreen::exhibit
