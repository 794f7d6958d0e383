// `frustumscreen run --mode-file`: the watchdog's mode, and the settings for it.

#include "firmware_host/base/json.h"
#include "tests/folders.h"
#include "tests/programs/kiosk_folder.h"

#include <fmt/format.h>
#include <sys/wait.h>

namespace frustumscreen::synthetic {
namespace {

class RunMode : public KioskFolder {
protected:
    void SetUp() override {
        KioskFolder::SetUp();
        for (const char* name : {"shipped", "cache", "library"}) {
            std::filesystem::create_directory(folder / name);
        }
        std::filesystem::copy_file(folder / "rings.fspack", folder / "shipped/built_in.fspack");
    }
    int run() const {
        return shell(fmt::format("'{}/frustumscreen' run --config kiosk.toml --mode-file mode "
                                 "--shipped shipped --cache cache --headless --fast --json --seconds 1 "
                                 ">out.json 2>err.txt",
                                 bin_dir()));
    }
    nlohmann::json status() const {
        EXPECT_EQ(run(), 0) << text("err.txt");
        return nlohmann::json::parse(text("out.json"), nullptr, false);
    }
};

TEST_F(RunMode, DefaultsToNormalWithoutAFileOrForAnUnknownMode) {
    EXPECT_EQ(status().at("mode"), "normal");
    EXPECT_EQ(text("err.txt").find("mode"), std::string::npos) << text("err.txt");
    put("mode", "sideways\n");
    EXPECT_EQ(status().at("mode"), "normal");
    EXPECT_NE(text("err.txt").find(
                  "unknown mode 'sideways'; allowed are normal, last_good_set, plain and built_in"),
              std::string::npos);
    put("mode", "normal\n");
    EXPECT_EQ(status().at("mode"), "normal");
    EXPECT_EQ(text("err.txt").find("mode"), std::string::npos) << text("err.txt");
}

TEST_F(RunMode, TheBuiltInArtifactNeedsNoPackOfTheSettings) {
    std::filesystem::remove(folder / "rings.fspack");
    EXPECT_NE(run(), 0);
    put("mode", "built_in\n");
    const nlohmann::json said = status();
    EXPECT_EQ(said.at("mode"), "built_in");
    EXPECT_EQ(said.at("artifact"), "Rings");
    EXPECT_EQ(said.at("settings"), "");
    EXPECT_EQ(said.at("set"), nullptr);
}

/// The safe picture's program reads no settings; the exhibit leaves it the layout. Settings that stand in for the kiosk's
/// own say nothing of its projector.
TEST_F(RunMode, TheStereoLayoutIsKeptForTheSafePicture) {
    const std::string usual = text("kiosk.toml");
    ASSERT_EQ(run(), 0) << text("err.txt");
    EXPECT_EQ(text("cache/stereo.txt"), "off\n");
    put("kiosk.toml", usual + "\n[eye]\nstereo = \"top_bottom\"\n");
    ASSERT_EQ(run(), 0) << text("err.txt");
    EXPECT_EQ(text("cache/stereo.txt"), "top_bottom\n");
    put("kiosk.toml", usual);
    put("mode", "built_in\n");
    ASSERT_EQ(run(), 0) << text("err.txt");
    EXPECT_EQ(text("cache/stereo.txt"), "top_bottom\n");
}

TEST_F(RunMode, PlainDrawingShowsThePacksOfTheSettings) {
    put("mode", "plain\n");
    const nlohmann::json said = status();
    EXPECT_EQ(said.at("mode"), "plain");
    EXPECT_EQ(said.at("artifact"), "Rings");
    EXPECT_FALSE(std::filesystem::exists(folder / "cache/mesa_shader_cache"))
        << "no compiled shader is taken or kept";
}

TEST_F(RunMode, FallsBackToOtherSettingsExceptInNormalMode) {
    const std::string good = text("kiosk.toml");
    put("kiosk.toml", "[projector]\nwidth = \"wide\"\n");
    EXPECT_EQ(run(), 1);
    EXPECT_NE(text("err.txt").find("kiosk.toml:2"), std::string::npos) << text("err.txt");

    put("mode", "built_in\n");
    EXPECT_EQ(run(), 1); // there are no fallback settings
    put("shipped/kiosk.toml", "[projector]\nwidth = 640\nheight = 400\n[tracker]\nkind = \"none\"\n");
    std::string why = status().at("settings");
    EXPECT_EQ(why.find("the settings as shipped, shipped/kiosk.toml, are used in their place: "), 0U) << why;

    put("cache/settings_last_good.toml", good);
    why = status().at("settings");
    EXPECT_EQ(why.find("the last good settings, cache/settings_last_good.toml, are used in their place: "),
              0U)
        << why;

    put("cache/settings_last_good.toml", "spoilt as well");
    why = status().at("settings");
    EXPECT_EQ(why.find("the settings as shipped"), 0U) << why;
}

} // namespace
} // namespace frustumscreen::synthetic
