// `frustumscreen camera` without a camera; tests/hil/test_camera.py tests it with one.

#include "firmware_host/base/json.h"
#include "tests/programs/program_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace frustumscreen::programs {
namespace {

class CameraCommand : public ProgramFolder {
protected:
    void settings(const std::string& camera) const { put("kiosk.toml", "[camera]\n" + camera); }
    [[nodiscard]] std::size_t files() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
    }
};

TEST_F(CameraCommand, ReportsWhetherTheSettingsHaveACamera) {
    settings("");
    EXPECT_EQ(run("frustumscreen camera --config kiosk.toml --is-on"), 1);
    EXPECT_EQ(text("out.txt") + text("err.txt"), "");
    EXPECT_EQ(run("frustumscreen camera --config kiosk.toml"), 0);
    EXPECT_NE(text("out.txt").find("camera.kind is \"none\""), std::string::npos) << text("out.txt");
    settings("kind = \"v4l2\"\n");
    EXPECT_EQ(run("frustumscreen camera --config kiosk.toml --is-on"), 0);
    EXPECT_EQ(text("out.txt") + text("err.txt"), "");
}

TEST_F(CameraCommand, ReportsAMissingCameraAndWritesNoFile) {
    settings("kind = \"v4l2\"\ndevice = \"/dev/no_such_camera\"\n");
    EXPECT_EQ(run("frustumscreen camera --config kiosk.toml --seconds 0.3"), 1);
    EXPECT_NE(text("out.txt").find("away: no camera is connected"), std::string::npos) << text("out.txt");
    EXPECT_EQ(run("frustumscreen camera --config kiosk.toml --seconds 0.3 --json"), 1);
    const nlohmann::json found = nlohmann::json::parse(text("out.txt"), nullptr, false);
    ASSERT_FALSE(found.is_discarded()) << text("out.txt");
    EXPECT_EQ(found["health"], "away");
    EXPECT_TRUE(found["set_up"].is_null());
    EXPECT_EQ(found["counts"]["frames"], 0);
    EXPECT_EQ(files(), 3U) << "the settings, and what the program said";
}

TEST_F(CameraCommand, ExitsWithTwoOnWrongUse) {
    settings("");
    EXPECT_EQ(run("frustumscreen camera"), 2);
    EXPECT_EQ(run("frustumscreen camera --config kiosk.toml --is-on --json"), 2);
    EXPECT_EQ(run("frustumscreen camera --config kiosk.toml --seconds 0"), 2);
}

} // namespace
} // namespace frustumscreen::programs
