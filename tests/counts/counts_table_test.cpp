// Sums, the table and the picture of days whose numbers are known.
#include "app/counts/counts_plot.h"
#include "app/counts/counts_table.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace frustumscreen::counts {
namespace {

using std::chrono::seconds;

constexpr std::chrono::sys_days monday = std::chrono::year(2026) / 11 / 23;

DayCounts day_of(int after_monday, int visits, std::size_t hour, const char* artifact = "Amphora") {
    DayCounts day;
    day.day = monday + std::chrono::days(after_monday);
    for (int k = 0; k < visits; ++k) {
        day.add({seconds(90), true, true, true, Sentence(artifact), Sentence(k % 2 == 0 ? "en" : "de")},
                hour);
    }
    return day;
}

TEST(CountsTable, SumsDaysHoursAndNames) {
    const CountsSummary summary =
        summary_of({day_of(0, 4, 10), day_of(5, 6, 14, "Cup"), day_of(12, 10, 14, "Cup")});
    EXPECT_EQ(summary.days, 3U);
    EXPECT_EQ(summary.first, monday);
    EXPECT_EQ(summary.last, monday + std::chrono::days(12));
    EXPECT_EQ(summary.all, (Tally{20, 1'800'000}));
    EXPECT_EQ(summary.hours[14].visits, 16U);
    EXPECT_EQ(summary.weekdays[5].visits, 16U) << "both Saturdays";
    EXPECT_EQ(summary.days_of_weekday[5], 2U);
    ASSERT_EQ(summary.artifacts.size(), 2U);
    EXPECT_EQ(summary.artifacts[0].name, "Cup");
    EXPECT_DOUBLE_EQ(minutes_of(summary.artifacts[0].tally), 24.0);
    const std::string text = counts_text({{day_of(0, 4, 10), day_of(5, 6, 14, "Cup")}, {}, {}});
    EXPECT_NE(text.find("10 visits, 15 minutes in all, 1.5 minutes each"), std::string::npos) << text;
    EXPECT_NE(text.find("between 14:00 and 15:00, and on a Saturday"), std::string::npos) << text;
}

TEST(CountsTable, ReportsMissingAndUndatedCounts) {
    EXPECT_EQ(counts_text({}), "No visits have been counted yet.\n");
    EXPECT_NE(counts_plot({}).find("No visits have been counted yet."), std::string::npos);
    EXPECT_EQ(counts_csv({}), "day,kind,name,visits,minutes\n");
    DayCounts undated = day_of(0, 2, 3);
    undated.day.reset();
    EXPECT_NE(counts_text({{}, undated, {}}).find("While the clock was wrong: 2 visits, 3 minutes"),
              std::string::npos);
}

TEST(CountsTable, WritesARowForEachNumberToCsv) {
    const std::string csv = counts_csv({{day_of(0, 4, 10, "=1+\"2\"")}, {}, {}});
    EXPECT_EQ(csv, "day,kind,name,visits,minutes\n"
                   "2026-11-23,hour,10,4,6.00\n"
                   "2026-11-23,artifact,\"'=1+\"\"2\"\"\",4,6.00\n"
                   "2026-11-23,language,\"de\",2,3.00\n"
                   "2026-11-23,language,\"en\",2,3.00\n");
}

TEST(CountsTable, GroupsNumbersByThousands) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1 000");
    EXPECT_EQ(grouped(1234567), "1 234 567");
}

TEST(CountsPlot, DrawsEachDayAndEachHour) {
    std::vector<DayCounts> days;
    for (int k = 0; k < 40; ++k) {
        days.push_back(day_of(k, k % 7, static_cast<std::size_t>(9 + k % 8), "A <b> & \"c\""));
    }
    const std::string plot = counts_plot(days);
    const auto count = [&plot](const std::string& what) {
        std::size_t found = 0;
        for (std::size_t at = plot.find(what); at != std::string::npos; at = plot.find(what, at + 1)) {
            ++found;
        }
        return found;
    };
    for (const DayCounts& day : days) {
        EXPECT_EQ(count(fmt::format("<title>{:%F}: ", *day.day)), 1U);
    }
    EXPECT_EQ(count(", 12:00: "), 40U);
    EXPECT_EQ(count("<title>2026-11-24, 10:00: 1 visits</title>"), 1U);
    EXPECT_EQ(count("A &lt;b&gt; &amp; &quot;c&quot;"), 1U);
    EXPECT_EQ(count("nan") + count("inf"), 0U);
}

} // namespace
} // namespace frustumscreen::counts
