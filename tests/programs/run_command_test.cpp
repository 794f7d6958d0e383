// `frustumscreen run` at rest, on a pack made in memory.

#include "app/render/probe.h"
#include "firmware_host/base/json.h"
#include "tests/base/told.h"
#include "tests/folders.h"
#include "tests/programs/kiosk_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <regex>
#include <string>

namespace frustumscreen::synthetic {
namespace {

class RunCommand : public KioskFolder {
protected:
    int exit_status(const std::string& more) const {
        return shell(fmt::format("'{}/frustumscreen' run --config kiosk.toml --headless --fast --json {} "
                                 ">out.json 2>err.txt",
                                 bin_dir(), more));
    }
    nlohmann::json run(const std::string& more) const {
        EXPECT_EQ(exit_status(more), 0) << text("err.txt");
        return nlohmann::json::parse(text("out.json"), nullptr, false);
    }
};

TEST_F(RunCommand, PlanListsContentsOmissionsAndSavings) {
    const auto say = [&](const std::string& more) {
        return shell(fmt::format("'{}/frustumscreen' plan --config kiosk.toml --pack rings.fspack {} "
                                 ">plan.txt 2>err.txt",
                                 bin_dir(), more));
    };
    ASSERT_EQ(say("--json"), 0) << text("err.txt");
    const nlohmann::json plan = nlohmann::json::parse(text("plan.txt"));
    const nlohmann::json& in = plan.at("in");
    EXPECT_EQ(in.at("levels").size(), 1U);
    EXPECT_EQ(in.at("planned_programs"), in.at("programs"));
    EXPECT_EQ(in.at("planned_gpu_bytes"), in.at("gpu_bytes"));
    EXPECT_EQ(in.at("tracker"), "replay");
    EXPECT_EQ(in.at("panel"), false);
    EXPECT_EQ(in.at("threads").size(), 1U);
    ASSERT_FALSE(plan.at("left_out").empty()); // at least two shaders
    EXPECT_EQ(plan.at("left_out")[0].at("economy"), "shaders");
    ASSERT_FALSE(plan.at("economies").empty());
    for (const nlohmann::json& each : plan.at("economies")) {
        for (const char* key : {"gpu_bytes", "ram_bytes", "frame_us", "frame_spread_us"}) {
            EXPECT_TRUE(each.at("saves").at(key).is_number()) << key;
        }
    }
    const nlohmann::json& measured = plan.at("measured");
    EXPECT_EQ(measured.at("planned").at("gpu_bytes"), in.at("gpu_bytes"));
    EXPECT_GT(measured.at("planned").at("frame_us"), 0.0);
    ASSERT_EQ(say(""), 0);
    const std::string page = text("plan.txt");
    for (const char* words :
         {"The exhibit needs", "It leaves out", "No button panel is opened", "Measured at"}) {
        EXPECT_NE(page.find(words), std::string::npos) << words;
    }
    EXPECT_NE(say("--technique level7"), 0);
    EXPECT_NE(text("err.txt").find("auto, finest and level0\n"), std::string::npos);
}

TEST_F(RunCommand, AtRestPresentsOneProbeASecondAndDrawsNothing) {
    const nlohmann::json shorter = run("--seconds 5");
    const nlohmann::json longer = run("--seconds 15");
    EXPECT_EQ(longer.at("frames"), 300);
    EXPECT_EQ(longer.at("drawn"), shorter.at("drawn")); // only while the caption fades in
    EXPECT_EQ(longer.at("probes").get<int>() - shorter.at("probes").get<int>(), 10);
    EXPECT_EQ(longer.at("drawn").get<int>() + longer.at("unchanged").get<int>(), 300);
}

TEST_F(RunCommand, ReportsLevelErrorsAndFrameTimes) {
    const auto begin = std::chrono::steady_clock::now();
    const nlohmann::json status = run("--seconds 2 --out pictures --stills 2 --status-file status.json");
    const double wall_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_EQ(status.at("technique"), "auto");
    EXPECT_EQ(status.at("level"), "level0");
    EXPECT_GE(status.at("samples"), 1);
    // A level's mean error along the eye's rays, which is twice the distance for a convex body (error_estimate.h).
    const double mm_per_box =
        1e3 * pack::place(rings(), settings::make_prop(settings::Settings().prop)).metres_per_box;
    const double mean_mm = status.at("estimated_error_mm");
    EXPECT_NEAR(mean_mm, 2e-3 * mm_per_box, 1e-3 * mm_per_box);
    EXPECT_NEAR(status.at("p95_error_mm").get<double>() / mean_mm, 2.0, 0.5); // as in the pack for this level
    // Frames come one after the other, all within the run.
    const nlohmann::json& frame_ms = status.at("frame_ms");
    const double median_ms = frame_ms.at("p50");
    EXPECT_GT(median_ms, 0.0);
    EXPECT_LE(median_ms, frame_ms.at("p95"));
    EXPECT_LE(frame_ms.at("p95"), frame_ms.at("p99"));
    EXPECT_LE(frame_ms.at("p99"), wall_ms);
    EXPECT_LE(median_ms * 0.5 * status.at("drawn").get<double>(), wall_ms);
    EXPECT_LE(status.at("missed_deadlines"), status.at("frames"));
    EXPECT_EQ(status.at("level_switches"), 0); // there is only one level
    EXPECT_EQ(status.at("ignored_times"), 0);
    const nlohmann::json file = nlohmann::json::parse(text("status.json"));
    EXPECT_EQ(file.at("level"), "level0");
    EXPECT_EQ(run("--seconds 1 --technique level0").at("technique"), "level0");
}

TEST_F(RunCommand, WritesAStillOfAShortRunAndNamesAMissingStatusFolder) {
    run("--seconds 0.1 --out pictures --stills 1");
    EXPECT_TRUE(std::filesystem::exists(folder / "pictures/frame_00000.png"));
    EXPECT_EQ(exit_status("--seconds 1 --status-file nowhere/status.json"), 1);
    EXPECT_NE(text("err.txt").find("nowhere: the folder of --status-file"), std::string::npos);
}

TEST_F(RunCommand, ReportsThatNoTrackerOrPanelIsUsed) {
    const nlohmann::json replayed = run("--seconds 1");
    EXPECT_EQ(replayed.at("tracker"), "poses come from a file; no tracker is used");
    EXPECT_EQ(replayed.at("panel"), ""); // there is no panel
    write_settings("simulated", "[[panel.script]]\nat_s = 1.0\nbutton = 2\n");
    const nlohmann::json simulated = run("--seconds 2 --soak 1");
    EXPECT_EQ(simulated.at("tracker"), "a simulated visitor moves the prop; no tracker is used");
    EXPECT_EQ(simulated.at("panel"), "presses come from a script; no buttons are used");
}

TEST_F(RunCommand, ListsThePacksThatItCannotShow) {
    const nlohmann::json status =
        run("--seconds 1 --status-file status.json --packs cat.fspack rings.fspack");
    const nlohmann::json file = nlohmann::json::parse(text("status.json"));
    for (const nlohmann::json& each : {status, file}) {
        EXPECT_EQ(each.at("left_out"),
                  nlohmann::json::array({{{"pack", "cat.fspack"}, {"reason", "there is no such file"}}}));
    }
}

TEST_F(RunCommand, SaysWhyNoPackCanBeShown) {
    const auto errors = [&](const std::string& packs) {
        EXPECT_NE(shell(fmt::format("'{}/frustumscreen' run --config kiosk.toml --headless --seconds 1 "
                                    "--packs {} >out.txt 2>err.txt",
                                    bin_dir(), packs)),
                  0);
        return text("err.txt");
    };
    EXPECT_TRUE(test::tells(errors("cat.fspack"),
                            {"frustumscreen: left out: cat.fspack: ",
                             "the pack cannot be shown: cat.fspack: ", "[show.no_pack_shown]\n"}));
    EXPECT_TRUE(test::tells(errors("cat.fspack ."), {"left out: cat.fspack: ", "left out: .: ",
                                                     "none of the 2 packs", "[show.no_pack_shown]\n"}));
}

TEST_F(RunCommand, SaysWhichSettingNamesAMissingPack) {
    std::filesystem::remove(folder / "rings.fspack");
    EXPECT_EQ(exit_status("--seconds 1"), 1);
    EXPECT_TRUE(
        test::tells(text("err.txt"),
                    {"frustumscreen: kiosk.toml:9: exhibit.packs: left out: rings.fspack: ",
                     "frustumscreen: kiosk.toml:9: exhibit.packs: the pack cannot be shown: rings.fspack: ",
                     "[show.no_pack_shown]\n"}));
}

TEST_F(RunCommand, SaysWhichSettingNamesAMissingPoseFile) {
    std::filesystem::remove(folder / "poses.csv");
    EXPECT_NE(shell(fmt::format(
                  "'{}/frustumscreen' run --config kiosk.toml --headless --seconds 1 >out.txt 2>err.txt",
                  bin_dir())),
              0);
    EXPECT_TRUE(test::tells(
        text("err.txt"), {"frustumscreen: kiosk.toml:7: tracker.poses: poses.csv: ", "[file.not_opened]\n"}));
}

TEST_F(RunCommand, SaysThatAPackWasBakedForAnotherPropAndItsError) {
    write_settings("replay", "[prop]\nkind = \"cube\"\nzone = \"table\"\n");
    run("--seconds 1");
    const Bytes errors = *read_file(folder / "err.txt");
    EXPECT_TRUE(std::regex_search(
        std::string(as_text(errors)),
        std::regex(
            "^frustumscreen: rings\\.fspack: it was baked for a frustum, and the prop of the settings is a "
            "cube; it is shown with a mean error of \\d+\\.\\d\\d mm; bake it with --prop cube\n")))
        << as_text(errors);
}

TEST_F(RunCommand, RefusesAPackWithoutTheSidesThatACubeInTheHandShows) {
    write_settings("replay", "[prop]\nkind = \"cube\"\n");
    EXPECT_EQ(exit_status("--seconds 1"), 1);
    EXPECT_TRUE(test::tells(text("err.txt"), {"frustumscreen: ", "left out: rings.fspack: ", "face +X",
                                              "--prop cube", "[show.no_pack_shown]\n"}));
}

TEST_F(RunCommand, SaysThatALanguageIsMissingAndReportsTheOneShown) {
    write_settings("replay", "language = \"en-GB\"\n");
    EXPECT_EQ(run("--seconds 1").at("language"), "en");
    const Bytes quiet = *read_file(folder / "err.txt");
    EXPECT_EQ(as_text(quiet).find("captions"), std::string_view::npos);
    write_settings("replay", "language = \"cy\"\n");
    EXPECT_EQ(run("--seconds 1").at("language"), "en");
    const Bytes errors = *read_file(folder / "err.txt");
    EXPECT_EQ(
        as_text(errors).rfind(
            "frustumscreen: no artifact has captions in 'cy', so en is shown; the captions are in en\n", 0),
        0U)
        << as_text(errors);
}

TEST_F(RunCommand, KeepsTheProbeOutOfItsStills) {
    run("--seconds 2 --out pictures --stills 2");
    for (const char* name : {"frame_00000.png", "frame_00001.png"}) {
        const image::Image8 still = image::decode_png8(*read_file(folder / "pictures" / name)).value();
        EXPECT_FALSE(render::read_probe(still));
        EXPECT_EQ(still.at(0, 0), glm::u8vec4(0, 0, 0, 255));
    }
}

} // namespace
} // namespace frustumscreen::synthetic
