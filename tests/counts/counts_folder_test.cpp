// The folder of days: damaged files are told and kept, old days go, and reading changes nothing.
#include "tests/counts/folder_of_counts.h"

namespace frustumscreen::counts {
namespace {

constexpr std::chrono::sys_days some_day = std::chrono::year(2026) / 11 / 27;

TEST_F(FolderOfCounts, ContinuesADay) {
    ASSERT_TRUE(keep_day(folder, counted(some_day, 3)));
    EXPECT_TRUE(has("2026-11-27.json"));
    const Result<OpenedDay> opened = open_day(folder, some_day);
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(opened->counts, counted(some_day, 3));
    EXPECT_EQ(opened->trouble, "");
    const Result<OpenedDay> next = open_day(folder, some_day + std::chrono::days(1));
    ASSERT_TRUE(next);
    EXPECT_EQ(next->counts.all(), Tally{});
}

TEST_F(FolderOfCounts, RenamesDamagedFilesWithoutOverwriting) {
    for (int k = 1; k <= 3; ++k) {
        put("2026-11-27.json", "damaged " + std::to_string(k));
        const Result<OpenedDay> opened = open_day(folder, some_day);
        ASSERT_TRUE(opened) << opened.error().message;
        EXPECT_EQ(opened->counts.all(), Tally{});
        EXPECT_NE(opened->trouble.find("it was renamed to 2026-11-27.json"), std::string::npos)
            << opened->trouble;
    }
    EXPECT_FALSE(has("2026-11-27.json"));
    EXPECT_EQ(text("2026-11-27.json.bad"), "damaged 1");
    EXPECT_EQ(text("2026-11-27.json.2.bad"), "damaged 2");
    EXPECT_EQ(text("2026-11-27.json.3.bad"), "damaged 3");
}

TEST_F(FolderOfCounts, ReportsAFileNamedForAnotherDay) {
    put("2026-11-27.json", write_day_counts(counted(some_day - std::chrono::days(1), 3)));
    const Result<OpenedDay> opened = open_day(folder, some_day);
    ASSERT_TRUE(opened);
    EXPECT_NE(opened->trouble, "");
}

TEST_F(FolderOfCounts, ReportsDamagedFilesWithoutChangingThem) {
    ASSERT_TRUE(keep_day(folder, counted(some_day, 3)));
    ASSERT_TRUE(keep_day(folder, counted(some_day - std::chrono::days(2), 5)));
    ASSERT_TRUE(keep_day(folder, counted(std::nullopt, 7)));
    put("2026-11-26.json", "{");
    put("2026-11-20.json.bad", "x");
    put("notes.txt", "not ours");
    put("2026-11-27.json.part1234", "x");
    const Result<ReadCounts> read = read_counts(folder);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->days.size(), 2U);
    EXPECT_EQ(read->days[0].all().visits, 5U);
    EXPECT_EQ(read->days[1].all().visits, 3U);
    EXPECT_EQ(read->undated.all().visits, 7U);
    ASSERT_EQ(read->trouble.size(), 2U);
    EXPECT_EQ(text("2026-11-26.json"), "{");
    EXPECT_FALSE(read_counts(folder / "nowhere"));
}

TEST_F(FolderOfCounts, RemovesTheOldestOfMoreThan400Days) {
    for (std::size_t k = 0; k < max_days + 5; ++k) {
        ASSERT_TRUE(keep_day(folder, counted(some_day - std::chrono::days(2 * k), 1)));
    }
    ASSERT_TRUE(keep_day(folder, counted(std::nullopt, 1)));
    put("2001-01-01.json.bad", "x");
    put("2001-01-01.txt", "not ours");
    drop_old_days(folder);
    const Result<ReadCounts> read = read_counts(folder);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->days.size(), max_days);
    EXPECT_EQ(read->days.back().day, some_day);
    EXPECT_EQ(read->undated.all().visits, 1U);
    EXPECT_FALSE(has("2001-01-01.json.bad"));
    EXPECT_TRUE(has("2001-01-01.txt"));
}

TEST_F(FolderOfCounts, ReportsAMissingFolder) {
    EXPECT_FALSE(keep_day(folder / "nowhere", counted(some_day, 1)));
}

} // namespace
} // namespace frustumscreen::counts
