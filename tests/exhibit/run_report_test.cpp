#include "app/programs/run_report.h"
#include "firmware_host/base/file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <random>

namespace frustumscreen {
namespace {

TEST(RunReport, QuantilesAreThoseOfTheSortedFramesOfTheWindow) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> ms(1.0F, 30.0F);
    FrameTimes times(500);
    std::vector<float> all;
    for (int k = 0; k < 1234; ++k) {
        all.push_back(ms(random));
        times.add(static_cast<double>(all.back()));
    }
    std::vector<float> last(all.end() - 500, all.end());
    std::sort(last.begin(), last.end());
    EXPECT_EQ(static_cast<float>(times.quantile(0.5)), last[249]);
    EXPECT_EQ(static_cast<float>(times.quantile(0.99)), last[494]);
    EXPECT_EQ(FrameTimes(10).quantile(0.5), 0.0);
}

TEST(RunReport, TheListOfFramesQuotesTitlesWithCommas) {
    const std::string csv = frames_csv({{1000, 2.5F, 0.25F, true, "Bowl, \"blue\"", "level2"}});
    EXPECT_EQ(csv, "frame,t_us,ms,technique,estimated_error_mm,drawn,artifact\n"
                   "0,1000,2.500,level2,0.2500,1,\"Bowl, \"\"blue\"\"\"\n");
}

TEST(RunReport, TheStatusFileHoldsTheLatestStatusAndOnlyThat) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("status_" + std::to_string(::getpid()) + ".json");
    const std::vector<PackLeftOut> left_out{{"cat.fspack", "there is no such file"}};
    const std::time_t before = std::time(nullptr);
    {
        StatusFile status_file(file);
        for (std::uint64_t k = 1; k <= 50; ++k) {
            RunStatus status;
            status.artifact = "Amphora";
            status.frames = k;
            status.left_out = left_out;
            status_file.post(status);
        }
    }
    const std::time_t after = std::time(nullptr);
    const Result<Bytes> bytes = read_file(file);
    ASSERT_TRUE(bytes);
    const nlohmann::json json = nlohmann::json::parse(as_text(*bytes));
    EXPECT_EQ(json.at("frames"), 50);
    EXPECT_EQ(json.at("artifact"), "Amphora");
    ASSERT_EQ(json.at("left_out").size(), 1U);
    EXPECT_EQ(json.at("left_out")[0].at("pack"), "cat.fspack");
    EXPECT_EQ(json.at("left_out")[0].at("reason"), "there is no such file");
    std::tm utc{};
    const std::string written_at = json.at("written_at");
    const char* const rest = ::strptime(written_at.c_str(), "%Y-%m-%dT%H:%M:%SZ", &utc);
    ASSERT_NE(rest, nullptr) << written_at;
    EXPECT_EQ(*rest, 0) << written_at;
    EXPECT_GE(::timegm(&utc), before);
    EXPECT_LE(::timegm(&utc), after);
    EXPECT_GT(json.at("resident_mib"), 0.0);
    EXPECT_FALSE(std::filesystem::exists(file.string() + ".part" + std::to_string(::getpid())));
    std::filesystem::remove(file);
    StatusFile nowhere{std::filesystem::path()};
    nowhere.post({});
}

TEST(RunReport, TextThatIsNotUtf8DoesNotSpoilTheStatus) {
    RunStatus status;
    status.artifact = "\xFF\xFE";
    EXPECT_TRUE(nlohmann::json::accept(status_json(status)));
}

} // namespace
} // namespace frustumscreen
