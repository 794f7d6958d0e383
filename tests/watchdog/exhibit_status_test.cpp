#include "app/programs/watchdog/exhibit_status.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace frustumscreen::programs {
namespace {

const std::string status =
    R"({"written_at": "2026-01-01T10:00:00Z", "monotonic_ns": 5000000000, "boot_id": "b1",
 "health": "well", "presented": {"code": 3, "drawn": 77}, "set": {"packs": [{"artifact": "", "health": "bad"}]},
 "artifact": "Amphora", "drawn": 10, "unchanged": 5, "probes": 7, "tracker_counts": {"connections": 1, "frames": 9},
 "tracker_hangs": true, "asleep": false})";

std::string with(std::string text, const std::string& what, const std::string& by) {
    const std::size_t place = text.find(what);
    EXPECT_NE(place, std::string::npos);
    return text.replace(place, what.size(), by);
}

TEST(ExhibitStatus, ReadsOnlyTopLevelFields) {
    const std::optional<ExhibitStatus> read = read_exhibit_status(status);
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->says.well);
    EXPECT_EQ(read->says.pictures, 17U);
    EXPECT_EQ(read->says.artifacts, 1U);
    EXPECT_TRUE(read->says.device_hangs);
    EXPECT_FALSE(read->says.asleep);
    EXPECT_EQ(read->boot_id, "b1");
    EXPECT_EQ(read->written_at, MonotonicTime(std::chrono::seconds(5)));
}

TEST(ExhibitStatus, ReadsFaultsAndSleep) {
    EXPECT_FALSE(read_exhibit_status(with(status, "\"well\"", "\"frozen\""))->says.well);
    EXPECT_EQ(read_exhibit_status(with(status, "\"Amphora\"", "\"\""))->says.artifacts, 0U);
    EXPECT_TRUE(read_exhibit_status(with(status, "\"asleep\": false", "\"asleep\": true"))->says.asleep);
}

TEST(ExhibitStatus, RejectsTextThatIsNoStatus) {
    for (const std::string& text :
         {std::string(), std::string("{"), std::string("[]"), std::string("{}"), status.substr(0, 200),
          status + "}", std::string(100'000, '['), with(status, "\"well\"", "7")}) {
        EXPECT_FALSE(read_exhibit_status(text)) << text.substr(0, 60);
    }
}

TEST(ExhibitStatus, AcceptsTimesOutOfRange) {
    EXPECT_TRUE(read_exhibit_status(with(status, "5000000000", "18446744073709551615")));
    EXPECT_TRUE(read_exhibit_status(with(status, "5000000000", "-5")));
    EXPECT_TRUE(read_exhibit_status(with(status, "5000000000", "1e300")));
}

TEST(ExhibitStatus, SurvivesChangedBytes) {
    std::mt19937 chance(3);
    std::size_t taken = 0;
    for (int round = 0; round < 20'000; ++round) {
        std::string changed = status;
        for (unsigned k = 0; k < 1 + round % 4U; ++k) {
            changed[chance() % changed.size()] = static_cast<char>(chance());
        }
        taken += read_exhibit_status(changed) ? 1 : 0;
    }
    EXPECT_GT(taken, 100U);
}

} // namespace
} // namespace frustumscreen::programs
