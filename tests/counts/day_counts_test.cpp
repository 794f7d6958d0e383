// A day's file: what is written is read again, and what is damaged is told, byte by byte.
#include "app/counts/day_counts.h"

#include <gtest/gtest.h>

#include <cctype>

namespace frustumscreen::counts {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

DayCounts example() {
    DayCounts counts;
    counts.day = std::chrono::year(2026) / 11 / 27;
    counts.add(
        {milliseconds(61'234), true, true, true, Sentence("Amphora \"of\" Exekias \u00e4"), Sentence("en")},
        9);
    counts.add({seconds(20), false, true, false, Sentence("Nautilus cup"), Sentence("en")}, 9);
    counts.add({seconds(45), true, true, true, Sentence("Nautilus cup"), Sentence("zh-Hans")}, 23);
    return counts;
}

TEST(DayCounts, AddsUp) {
    const DayCounts counts = example();
    EXPECT_EQ(counts.all(), (Tally{2, 126'234}));
    EXPECT_EQ(counts.hours[9], (Tally{1, 81'234}));
    EXPECT_EQ(counts.hours[23], (Tally{1, 45'000}));
    EXPECT_EQ(counts.artifacts.at("Nautilus cup"), (Tally{2, 65'000}));
    EXPECT_EQ(counts.languages.at("en"), (Tally{1, 81'234}));
    DayCounts twice = counts;
    twice.add(counts);
    EXPECT_EQ(twice.all(), (Tally{4, 252'468}));
    EXPECT_EQ(twice.artifacts.size(), 2U);
}

TEST(DayCounts, RoundTrip) {
    DayCounts counts = example();
    Result<DayCounts> read = parse_day_counts(write_day_counts(counts));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, counts);
    counts.day.reset();
    read = parse_day_counts(write_day_counts(counts));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, counts);
    EXPECT_TRUE(parse_day_counts(write_day_counts({})));
}

TEST(DayCounts, CleansNamesAndReadsThemBack) {
    DayCounts counts;
    counts.add({seconds(1), true, true, true, Sentence("a\nb\x1b[2J"), Sentence("\xff")}, 0);
    const Result<DayCounts> read = parse_day_counts(write_day_counts(counts));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, counts);
    EXPECT_EQ(read->artifacts.begin()->first, "a?b?[2J");
}

TEST(DayCounts, LimitsTheNumberOfNames) {
    DayCounts counts;
    for (int k = 0; k < 1000; ++k) {
        counts.add({seconds(1), true, true, true, Sentence(std::to_string(k)), Sentence("en")}, 5);
    }
    EXPECT_LE(counts.artifacts.size(), max_counted_names + 1);
    EXPECT_EQ(counts.artifacts.at(std::string(other_names)).ms, 800'000U);
    const Result<DayCounts> read = parse_day_counts(write_day_counts(counts));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, counts);
}

/// A digit of a time that flips is seen by the sums; one of a visit's number is not, so it is left out here.
TEST(DayCounts, RejectsADamagedTime) {
    const std::string whole = write_day_counts(example());
    std::size_t flipped = 0;
    for (std::size_t at = whole.find("\"ms\": "); at != std::string::npos;
         at = whole.find("\"ms\": ", at + 1)) {
        for (std::size_t digit = at + 6; std::isdigit(static_cast<unsigned char>(whole[digit])) != 0;
             ++digit) {
            std::string damaged = whole;
            damaged[digit] = damaged[digit] == '7' ? '8' : '7';
            const Result<DayCounts> read = parse_day_counts(damaged);
            EXPECT_FALSE(read) << damaged;
            ++flipped;
        }
    }
    EXPECT_GT(flipped, 20U);
}

TEST(DayCounts, RejectsTruncatedFiles) {
    const std::string whole = write_day_counts(example());
    for (std::size_t size = 0; size + 2 < whole.size(); ++size) { // the last two bytes are } and a line feed
        const Result<DayCounts> read = parse_day_counts(std::string_view(whole).substr(0, size));
        ASSERT_FALSE(read) << size;
        EXPECT_EQ(read.error().id, "counts.none");
    }
}

TEST(DayCounts, RejectsInvalidFiles) {
    const auto id_of = [](const char* text) {
        const Result<DayCounts> read = parse_day_counts(text);
        return read ? std::string("read") : std::string(read.error().id.view());
    };
    EXPECT_EQ(id_of("[]"), "counts.none");
    EXPECT_EQ(id_of(R"({"a": 1})"), "counts.none");
    EXPECT_EQ(id_of(R"({"frustumscreen_counts": 2})"), "counts.version");
    EXPECT_EQ(id_of(R"({"frustumscreen_counts": 1})"), "counts.damaged");
    EXPECT_EQ(
        id_of(
            R"({"frustumscreen_counts": 1, "day": "2026-02-30", "hours": [], "artifacts": [], "languages": []})"),
        "counts.damaged");
    EXPECT_EQ(
        id_of(R"({"frustumscreen_counts": 1, "day": null, "hours": [], "artifacts": [], "languages": []})"),
        "read");
    for (const char* hour :
         {R"({"hour": 24, "visits": 0, "ms": 0})", R"({"hour": -1, "visits": 0, "ms": 0})",
          R"({"hour": 1, "visits": -1, "ms": 0})", R"({"hour": 1, "visits": 0, "ms": 1e30})",
          R"({"hour": 1, "visits": 0})", "3", "null", "[]"}) {
        const std::string text = std::string(R"({"frustumscreen_counts": 1, "day": null, "hours": [)") +
                                 hour + R"(], "artifacts": [], "languages": []})";
        EXPECT_EQ(id_of(text.c_str()), "counts.damaged") << hour;
    }
}

} // namespace
} // namespace frustumscreen::counts
