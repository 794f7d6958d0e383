// `frustumscreen run` with a screen behind the table, without either screen.
#include "app/image/image.h"
#include "firmware_host/base/json.h"
#include "tests/folders.h"
#include "tests/programs/kiosk_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace frustumscreen::synthetic {
namespace {

constexpr const char* screen_table = "[display]\nconnector = \"HDMI-A-1\"\n[screen]\nroom = "
                                     "\"room.toml\"\nconnector = \"DP-1\"\nwidth = 160\nheight = 90\n";

class RunScreen : public KioskFolder {
protected:
    void SetUp() override {
        KioskFolder::SetUp();
        put("room.toml", "[[object]]\npack = \"rings.fspack\"\nartifact = \"elsewhere\"\nplace_m = [0.0, "
                         "1.0, 0.3]\nsize_m = 0.4\n");
        write_settings("replay", screen_table);
    }
    nlohmann::json run(const std::string& more) const {
        const int status =
            shell(fmt::format("rm -rf pictures; '{}/frustumscreen' run --config kiosk.toml --headless "
                              "--fast --json --out pictures --stills 2 --seconds 2 {} "
                              ">out.json 2>err.txt",
                              bin_dir(), more));
        EXPECT_EQ(status, 0) << text("err.txt");
        return nlohmann::json::parse(text("out.json"), nullptr, false);
    }
    [[nodiscard]] image::Image8 picture(const std::string& name) const {
        return image::decode_png8(read_file(folder / "pictures" / name).value()).value();
    }
    [[nodiscard]] bool has(const std::string& name) const {
        return std::filesystem::exists(folder / "pictures" / name);
    }
};

TEST_F(RunScreen, WritesStillsOfBothOutputsAndMatchesRender) {
    const nlohmann::json status = run("");
    const nlohmann::json& shown = status.at("screen_picture");
    EXPECT_EQ(shown.at("health"), "well");
    EXPECT_GT(shown.at("presented"), 0);
    EXPECT_EQ(shown.at("held_up"), 0);
    EXPECT_LT(shown.at("drawn"), 5) << "nothing moves";
    for (const char* name : {"frame_00000.png", "frame_00001.png", "screen_00000.png", "screen_00001.png"}) {
        EXPECT_TRUE(has(name)) << name;
    }
    const image::Image8 live = picture("screen_00001.png");
    EXPECT_EQ(live.width, 160U);
    EXPECT_EQ(live.height, 90U);
    const auto lit =
        std::count_if(live.texels.begin(), live.texels.end(), [](const auto& texel) { return texel.x > 20; });
    EXPECT_GT(lit, 300);
    ASSERT_EQ(shell(fmt::format(
                  "'{}/frustumscreen' render --config kiosk.toml --pack rings.fspack --poses poses.csv "
                  "--output screen --out rendered >log.txt 2>&1",
                  bin_dir())),
              0)
        << text("log.txt");
    const image::Image8 rendered =
        image::decode_png8(read_file(folder / "rendered/frame_00000.png").value()).value();
    EXPECT_EQ(rendered.texels, live.texels);
    EXPECT_EQ(picture("frame_00001.png").width, 320U);
}

TEST_F(RunScreen, TheProjectorsPictureIsTheSameWithAScreenBesideIt) {
    run("");
    const image::Image8 with = picture("frame_00001.png");
    write_settings("replay", "");
    const nlohmann::json status = run("");
    EXPECT_EQ(picture("frame_00001.png").texels, with.texels);
    EXPECT_TRUE(status.at("screen_picture").is_null());
    EXPECT_TRUE(status.at("devices").at("screen").at("ok").is_null());
    EXPECT_FALSE(has("screen_00000.png"));
}

TEST_F(RunScreen, UnreadableRoomLeavesTheProjectorRunning) {
    put("room.toml", "[[object]]\npack = \"missing.fspack\"\n");
    const nlohmann::json status = run("");
    EXPECT_NE(status.at("screen").get<std::string>().find("missing.fspack"), std::string::npos)
        << status.at("screen");
    EXPECT_EQ(status.at("devices").at("screen").at("ok"), false);
    EXPECT_EQ(status.at("devices").at("display").at("ok").is_null(), true);
    EXPECT_TRUE(has("frame_00001.png"));
    EXPECT_FALSE(has("screen_00000.png"));
    EXPECT_GT(status.at("drawn"), 0);
}

TEST_F(RunScreen, PatternHasNoScreenPicture) {
    EXPECT_TRUE(run("--pattern").at("screen_picture").is_null());
}

TEST_F(RunScreen, PlanSaysWhetherThereIsAScreen) {
    const auto plan = [&] {
        EXPECT_EQ(shell(fmt::format(
                      "'{}/frustumscreen' plan --config kiosk.toml --pack rings.fspack >plan.txt 2>err.txt",
                      bin_dir())),
                  0)
            << text("err.txt");
        return text("plan.txt");
    };
    EXPECT_NE(plan().find("screen behind the table: yes"), std::string::npos);
    write_settings("replay", "");
    EXPECT_NE(plan().find("No screen is opened and no room is read"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::synthetic
