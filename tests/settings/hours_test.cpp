// The opening hours in the settings.

#include "app/settings/describe_settings.h"
#include "app/settings/missing_files.h"
#include "tests/settings/settings_text.h"

namespace frustumscreen::settings {
namespace {

TEST(Hours, ParsesOpeningHours) {
    const Result<CheckedSettings> settings =
        parse_settings("[hours]\nmonday = []\ntuesday = [\"10:00-18:00\", \"20:00-02:00\"]\n"
                       "exceptions = [\"2026-12-24 10:00-14:00\", \"2026-12-25 closed\"]\n"
                       "time_zone = \"Europe/Berlin\"\n",
                       "kiosk.toml");
    ASSERT_TRUE(settings) << settings.error().message;
    const HoursSettings& hours = (*settings)->hours;
    EXPECT_TRUE(hours.weekdays[0].empty());
    EXPECT_EQ(hours.weekdays[1], (HoursSettings::Day{{600, 1080}, {1200, 1560}}));
    EXPECT_EQ(hours.weekdays[6], (HoursSettings::Day{{0, 1440}})) << "left out: all day";
    const std::chrono::sys_days eve{std::chrono::year(2026) / 12 / 24};
    EXPECT_EQ(hours.exceptions, (std::vector<HoursException>{{eve, OpenSpan{600, 840}},
                                                             {eve + std::chrono::days(1), std::nullopt}}));
    EXPECT_EQ(hours.time_zone, "Europe/Berlin");
}

TEST(Hours, RoundTrip) {
    for (const char* text : {"00:00-24:00", "10:00-18:00", "20:00-02:00", "23:59-00:00", "00:00-00:01"}) {
        const std::optional<OpenSpan> span = parse_open_span(text);
        ASSERT_TRUE(span) << text;
        EXPECT_EQ(parse_open_span(text_of_span(*span)), span) << text;
    }
    EXPECT_EQ(text_of_span({0, minutes_a_day}), "00:00-24:00");
    for (const char* text : {"2026-12-24 10:00-14:00", "2028-02-29 closed"}) {
        EXPECT_EQ(text_of_exception(parse_hours_exception(text).value()), text);
    }
}

TEST(Hours, RefusesInvalidHours) {
    for (const char* span : {"10-18", "10:00", "10:00-10:00", "24:00-02:00", "10:60-11:00", "25:00-26:00",
                             "10:00 - 18:00", "-10:00-18:00"}) {
        const std::string message = refusal(std::string("[hours]\n\nfriday = [\"") + span + "\"]\n");
        EXPECT_TRUE(test::tells(message, {"set/kiosk.toml:3: hours.friday ", span, "10:00-18:00",
                                          "00:00-24:00", "[settings.meaning]"}))
            << message;
    }
    for (const char* day : {"2026-02-30 closed", "closed", "2026-12-24", "2026-12-24 open",
                            "24.12.2026 closed", "2026-12-24  closed", "2026-12-24 closed "}) {
        EXPECT_NE(
            refusal(std::string("[hours]\nexceptions = [\"") + day + "\"]\n").find("allowed are days such"),
            std::string::npos)
            << day;
    }
    for (const char* zone : {"/etc/localtime", "Europe/Ber lin", ":UTC", "../../etc/passwd"}) {
        EXPECT_NE(refusal(std::string("[hours]\ntime_zone = \"") + zone + "\"\n").find("[settings.meaning]"),
                  std::string::npos)
            << zone;
    }
    EXPECT_TRUE(test::tells(
        refusal("[hours]\nexceptions = [\"2026-12-24 closed\", \"2026-12-24 10:00-14:00\"]\n"),
        {"set/kiosk.toml:2: hours.exceptions ", "2026-12-24 closed", "[settings.exception_twice]"}));
}

TEST(Hours, ReportsAnUnknownTimeZone) {
    Settings settings;
    settings.hours.time_zone = "Europe/Nowhere";
    const std::vector<std::string> lines = missing_files(settings);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_NE(lines[0].find("no time zone \"Europe/Nowhere\""), std::string::npos) << lines[0];
}

TEST(Hours, AcceptsHoursWithoutALeadingZero) {
    EXPECT_EQ(parse_open_span("9:00-18:00"), parse_open_span("09:00-18:00"));
    EXPECT_EQ(text_of_span(*parse_open_span("9:00-18:00")), "09:00-18:00");
    EXPECT_FALSE(parse_open_span("9-18"));
    EXPECT_FALSE(parse_open_span(":00-18:00"));
    EXPECT_FALSE(parse_open_span("009:00-18:00"));
}

} // namespace
} // namespace frustumscreen::settings
