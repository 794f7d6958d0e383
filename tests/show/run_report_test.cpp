#include "app/show/run_report.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/json.h"
#include "tests/base/comes_true.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>

namespace frustumscreen::show {
namespace {

TEST(RunReport, QuantilesCoverTheRecentFramesOnly) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> ms(1.0F, 30.0F);
    RecentFrameTimes times(500);
    std::vector<float> all;
    for (int k = 0; k < 1234; ++k) {
        all.push_back(ms(random));
        times.add(static_cast<double>(all.back()));
    }
    std::vector<float> last(all.end() - 500, all.end());
    std::sort(last.begin(), last.end());
    EXPECT_EQ(static_cast<float>(times.quantile(0.5)), last[249]);
    EXPECT_EQ(static_cast<float>(times.quantile(0.99)), last[494]);
    EXPECT_EQ(RecentFrameTimes(10).quantile(0.5), 0.0);
}

TEST(RunReport, FrameListQuotesTitlesWithCommas) {
    const std::string csv = frames_csv(
        {{1000, 2.5F, scene::ErrorEstimate{0.25, 0.5}, true, "Bowl, \"blue\"", "level2", "view", "en", {}}});
    EXPECT_EQ(csv,
              "frame,t_us,ms,technique,estimated_error_mm,drawn,artifact,state,language,told,p95_error_mm\n"
              "0,1000,2.500,level2,0.2500,1,\"Bowl, \"\"blue\"\"\",view,en,,0.5000\n");
}

TEST(RunReport, FrameListNamesTheSpokenText) {
    FrameRow row;
    const auto ending = [&](ToldText told) {
        row.told = told;
        const std::string csv = frames_csv({row});
        return csv.substr(csv.rfind(',', csv.rfind(',') - 1));
    };
    EXPECT_EQ(ending({ToldText::Kind::Description, 2}),
              ",description.2,\n"); // no artifact is shown: no error
    EXPECT_EQ(ending({ToldText::Kind::Label, 0}), ",label.0,\n");
    EXPECT_EQ(ending({ToldText::Kind::Words, 0}), ",words,\n");
}

TEST(RunReport, StatusFileHoldsOnlyTheLatestStatus) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("status_" + std::to_string(::getpid()) + ".json");
    const auto left_out = std::make_shared<const std::vector<library::UnshownPack>>(
        std::vector<library::UnshownPack>{{"cat.fspack", "there is no such file"}});
    const auto set = std::make_shared<status::SetStatus>();
    set->shown = 7;
    set->packs.emplace_back().title = "A cat";
    set->newest = {8, library::TrialState::Bad, 2, "dog.fspack: it is damaged"};
    const std::time_t before = std::time(nullptr);
    {
        StatusFile status_file({.status_file = file});
        for (std::uint64_t k = 1; k <= 50; ++k) {
            RunStatus status;
            status.artifact = "Amphora";
            status.frames = k;
            status.left_out = left_out;
            status.set = set;
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
    EXPECT_EQ(json.at("set").at("number"), 7);
    EXPECT_EQ(json.at("set").at("packs")[0].at("title"), "A cat");
    EXPECT_EQ(json.at("set").at("newest").at("verdict"), "bad");
    EXPECT_EQ(json.at("set").at("newest").at("reason"), "dog.fspack: it is damaged");
    EXPECT_EQ(json.at("set").at("trouble"), "");
    RunStatus hanging;
    hanging.set = set;
    hanging.library_hangs = true;
    EXPECT_EQ(nlohmann::json::parse(status::status_json(hanging)).at("set").at("trouble"),
              status::library_hangs_sentence);
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
    StatusFile nowhere{{.status_file = {}}};
    nowhere.post({});
}

TEST(RunReport, StatusContainsThePresentedPictureAndTheCounts) {
    RunStatus status;
    status.health = "frozen";
    status.presented = {std::uint8_t{7}, {0.1, 0.2, 0.3}, {0.5, 0.5, 0.5, 0.5}, {0.0, -0.5, 0.25}, true};
    status.shown_code = std::uint8_t{6};
    status.tracker_counts.lost = 3;
    status.prop_by = "tags";
    status.source_changes = 5;
    status.eye_by = "camera";
    status.eye_sd_m = 0.021;
    status.camera_hz = 29.97;
    status.drift_m = 0.00312;
    status.drifted = true;
    status.tracker_counts.broken = 4;
    status.tracker_counts.clock_drift = 25e-6;
    stamp(status);
    const MonotonicTime after = monotonic_now();
    const nlohmann::json json = nlohmann::json::parse(status::status_json(status));
    EXPECT_EQ(json.at("health"), "frozen");
    EXPECT_EQ(json.at("presented").at("code"), 7);
    EXPECT_EQ(json.at("presented").at("prop_m"), (std::vector{0.1, 0.2, 0.3}));
    EXPECT_EQ(json.at("presented").at("prop_wxyz"), (std::vector{0.5, 0.5, 0.5, 0.5}));
    EXPECT_EQ(json.at("presented").at("eye_m"), (std::vector{0.0, -0.5, 0.25}));
    EXPECT_EQ(json.at("presented").at("settled"), true);
    EXPECT_EQ(json.at("shown_code"), 6);
    EXPECT_EQ(json.at("tracker_counts").at("lost"), 3);
    EXPECT_EQ(json.at("prop_by"), "tags");
    EXPECT_EQ(json.at("hand_overs"), 5);
    EXPECT_EQ(json.at("eye_by"), "camera");
    EXPECT_EQ(json.at("eye_sd_mm"), 21.0);
    EXPECT_EQ(json.at("camera_hz"), 29.97);
    EXPECT_EQ(json.at("drift_mm"), 3.12);
    EXPECT_EQ(json.at("drifted"), true);
    EXPECT_EQ(json.at("tracker_counts").at("broken"), 4);
    EXPECT_EQ(json.at("tracker_counts").at("clock_drift_ppm"), 25.0);
    EXPECT_LE(json.at("monotonic_ns"), after.time_since_epoch().count());
    EXPECT_GT(json.at("monotonic_ns"), (after - std::chrono::minutes(1)).time_since_epoch().count());
    std::string boot;
    std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), boot);
    EXPECT_EQ(json.at("boot_id"), boot);
}

TEST(RunReport, StatusFileRecordsTheBeginAndEndOfAHang) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("hang_" + std::to_string(::getpid()) + ".json");
    const auto comes = [&file](std::string_view health) {
        return comes_true([&] {
            const Result<Bytes> bytes = read_file(file);
            return bytes && nlohmann::json::parse(as_text(*bytes)).at("health") == health;
        });
    };
    {
        StatusFile status_file({.status_file = file});
        status_file.post({});
        EXPECT_TRUE(comes("well"));
        status_file.note_hang(true);
        EXPECT_TRUE(comes("hangs"));
        status_file.note_hang(false);
        EXPECT_TRUE(comes("well"));
    }
    std::filesystem::remove(file);
}

} // namespace
} // namespace frustumscreen::show
