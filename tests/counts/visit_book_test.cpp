// When the numbers are written, and to which day they belong; then the same through the thread.
#include "app/counts/visit_book.h"
#include "tests/base/comes_true.h"
#include "tests/counts/folder_of_counts.h"

namespace frustumscreen::counts {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;
using std::chrono::sys_seconds;

constexpr sys_seconds friday = std::chrono::sys_days(std::chrono::year(2026) / 11 / 27);
constexpr MonotonicTime start{seconds(5000)};

VisitPiece piece(const char* artifact = "Amphora") {
    return {seconds(10), true, true, true, Sentence(artifact), Sentence("en")};
}
LocalOffset an_hour_east() {
    return [](sys_seconds) { return seconds(3600); };
}

class KeptDays : public FolderOfCounts {
protected:
    void take(int pieces, Nanoseconds after, sys_seconds wall) {
        const std::vector<VisitPiece> all(static_cast<std::size_t>(pieces), piece());
        keeper_.take(all, start + after, wall);
    }
    [[nodiscard]] std::uint64_t kept(const char* name) const {
        const Result<DayCounts> read = parse_day_counts(text(name));
        return read ? read->all().visits : 0;
    }
    DayKeeper keeper_{folder, an_hour_east()};
};

TEST_F(KeptDays, AreWrittenTenMinutesAfterAVisit) {
    take(0, seconds(0), friday + hours(10));
    take(0, hours(3), friday + hours(13));
    EXPECT_FALSE(has("2026-11-27.json")) << "nothing was counted";
    take(2, hours(3) + seconds(1), friday + hours(13));
    take(1, hours(3) + minutes(9), friday + hours(13));
    EXPECT_FALSE(has("2026-11-27.json")) << "flash wears out";
    EXPECT_EQ(keeper_.visits().today.visits, 3U);
    take(0, hours(3) + minutes(10) + seconds(1), friday + hours(13));
    EXPECT_EQ(kept("2026-11-27.json"), 3U);
    std::filesystem::remove(folder / "2026-11-27.json");
    take(0, hours(5), friday + hours(15));
    EXPECT_FALSE(has("2026-11-27.json")) << "nothing new was counted";
}

TEST_F(KeptDays, BeginAtLocalMidnight) {
    take(2, seconds(0), friday + hours(22) + minutes(59)); // 23:59 there
    take(3, minutes(1), friday + hours(23));
    EXPECT_EQ(kept("2026-11-27.json"), 2U) << "the old day is written when the new one begins";
    EXPECT_EQ(keeper_.visits().today.visits, 3U);
    EXPECT_EQ(keeper_.visits().since_start.visits, 5U);
    keeper_.finish();
    EXPECT_EQ(kept("2026-11-28.json"), 3U);
    const Result<DayCounts> read = parse_day_counts(text("2026-11-27.json"));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->hours[23].visits, 2U);
}

TEST_F(KeptDays, ContinueAfterARestart) {
    ASSERT_TRUE(keep_day(folder, counted(std::chrono::floor<std::chrono::days>(friday), 4)));
    take(1, seconds(0), friday + hours(10));
    EXPECT_EQ(keeper_.visits().today.visits, 5U);
    EXPECT_EQ(keeper_.visits().since_start.visits, 1U);
    keeper_.finish();
    EXPECT_EQ(kept("2026-11-27.json"), 5U);
}

TEST_F(KeptDays, AreUndatedWhileTheClockIsWrong) {
    take(2, seconds(0), sys_seconds(seconds(1000)));
    take(1, minutes(1), friday + hours(10)); // it was set
    keeper_.finish();
    EXPECT_EQ(kept("undated.json"), 2U);
    EXPECT_EQ(kept("2026-11-27.json"), 1U);
    EXPECT_FALSE(has("1970-01-01.json"));
}

TEST_F(KeptDays, ReportADamagedFileAndContinueCounting) {
    put("2026-11-27.json", "damaged");
    take(1, seconds(0), friday + hours(10));
    EXPECT_NE(keeper_.visits().trouble.find("2026-11-27.json.bad"), std::string::npos);
    keeper_.finish();
    EXPECT_EQ(kept("2026-11-27.json"), 1U);
    EXPECT_EQ(text("2026-11-27.json.bad"), "damaged");
    EXPECT_NE(keeper_.visits().trouble, "") << "the disk needs attention";
}

TEST_F(KeptDays, AreWrittenAgainAfterAFailure) {
    const std::filesystem::path away = folder.string() + ".away";
    take(3, seconds(0), friday + hours(10));
    std::filesystem::rename(folder, away);
    take(0, minutes(11), friday + hours(10));
    EXPECT_NE(keeper_.visits().trouble, "");
    EXPECT_EQ(keeper_.visits().today.visits, 3U);
    std::filesystem::rename(away, folder);
    take(0, minutes(11) + seconds(30), friday + hours(10));
    EXPECT_FALSE(has("2026-11-27.json")) << "a disk that fails is not asked each second";
    take(0, minutes(13), friday + hours(10));
    EXPECT_EQ(kept("2026-11-27.json"), 3U);
    EXPECT_EQ(keeper_.visits().trouble, "");
}

TEST_F(FolderOfCounts, KeepsTheVisitsOfABookWhenItEnds) {
    constexpr int rounds = 50;
    {
        VisitBook book(folder, [](sys_seconds) { return seconds(0); });
        std::vector<VisitPiece> pieces;
        for (int k = 0; k < rounds; ++k) {
            pieces.push_back(piece(k % 2 == 0 ? "Amphora" : "Cup"));
            while (!pieces.empty()) { // the other side may be at it
                book.post(pieces);
            }
        }
        CountedVisits visits;
        EXPECT_TRUE(comes_true([&] {
            book.read(visits);
            return visits.since_start.visits == rounds;
        })) << visits.since_start.visits;
        EXPECT_EQ(visits.trouble, "");
    }
    const Result<ReadCounts> read = read_counts(folder);
    ASSERT_TRUE(read) << read.error().message;
    std::uint64_t visits = 0;
    std::uint64_t ms = 0;
    for (const DayCounts& day : read->days) { // two, where this ran at midnight
        visits += day.all().visits;
        ms += day.artifacts.at("Cup").ms;
    }
    EXPECT_EQ(visits, std::uint64_t{rounds});
    EXPECT_EQ(ms, 250'000U);
}

} // namespace
} // namespace frustumscreen::counts
