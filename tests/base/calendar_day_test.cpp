// Days as texts, compared with days since 1970 from another source (date -d).
#include "firmware_host/base/calendar_day.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

std::chrono::sys_days after_1970(int days) {
    return std::chrono::sys_days(std::chrono::days(days));
}

TEST(CalendarDay, RoundTrip) {
    for (const auto& [text, days] : {std::pair("1970-01-01", 0), std::pair("2000-02-29", 11016),
                                     std::pair("2026-11-23", 20780), std::pair("2100-01-01", 47482)}) {
        EXPECT_EQ(text_of_day(after_1970(days)), text);
        EXPECT_EQ(parse_day(text), after_1970(days)) << text;
    }
}

TEST(CalendarDay, RejectsOtherText) {
    for (const std::string_view text : {"", "2030", "2030-12", "2030-12-32", "2030-13-01", "2030-00-10",
                                        "2100-02-29", "2030-1-1", "2030-12-31 ", " 2030-12-31", "+030-12-31",
                                        "2030/12/31", "2030-12-3a", "20301231", "2030-12-311"}) {
        EXPECT_EQ(parse_day(text), std::nullopt) << text;
    }
}

} // namespace
} // namespace frustumscreen
