// Each way in which `frustumscreen run` ends before or after its loop, with its exit status and message.

#include "tests/folders.h"
#include "tests/programs/kiosk_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

namespace frustumscreen::synthetic {
namespace {

class RunRefusals : public KioskFolder {
protected:
    /// `service`: a service manager is named, but does not listen.
    [[nodiscard]] int run(const std::string& options, bool service = false) {
        const int status = shell(fmt::format("{} '{}/frustumscreen' run {} >out.txt 2>err.txt",
                                             service ? "NOTIFY_SOCKET=$PWD/nobody" : "env -u NOTIFY_SOCKET",
                                             bin_dir(), options));
        said = text("err.txt");
        return status;
    }
    [[nodiscard]] bool says(const std::string& words) const { return said.find(words) != std::string::npos; }

    std::string said;
};
constexpr const char* usual = "--config kiosk.toml --headless --fast --seconds 1 ";

TEST_F(RunRefusals, ExitsWithTwoOnWrongUse) {
    for (const std::string options : {"", "--config", "--no-such-option", "--config kiosk.toml --out out",
                                      "--config kiosk.toml --seconds 0", "--config kiosk.toml --soak 3",
                                      "--config kiosk.toml --technique cat"}) {
        EXPECT_EQ(run(options), 2) << options;
        EXPECT_FALSE(said.empty()) << options;
    }
    EXPECT_EQ(run("--help"), 0);
}

TEST_F(RunRefusals, NamesMissingSettings) {
    EXPECT_EQ(run("--config nowhere.toml --headless --fast --seconds 1"), 1);
    EXPECT_TRUE(says("nowhere.toml")) << said;
}

TEST_F(RunRefusals, NamesAnOutputFolderThatCannotBeCreated) {
    EXPECT_EQ(run(std::string(usual) + "--out kiosk.toml/out"), 1);
    EXPECT_TRUE(says("kiosk.toml/out: the folder cannot be made")) << said;
}

TEST_F(RunRefusals, ReportsAMissingCardAtOnceWithoutAService) {
    write_settings("replay", "[display]\nkind = \"kms\"\ncard = \"no-such-card\"\n");
    EXPECT_EQ(run("--config kiosk.toml --seconds 1"), 1);
    EXPECT_TRUE(says("/dev/dri/no-such-card")) << said;
}

TEST_F(RunRefusals, ATrackerWithoutPacketsIsNotRecorded) {
    EXPECT_EQ(run(std::string(usual) + "--record new.packets"), 1);
    EXPECT_TRUE(says("tracker.kind")) << said;
    EXPECT_FALSE(std::filesystem::exists(folder / "new.packets"));
}

TEST_F(RunRefusals, ServiceShowsTheErrorForAMinuteAndThenFails) {
    std::filesystem::remove(folder / "rings.fspack");
    const std::string options = "--config kiosk.toml --headless --fast --json --seconds ";
    EXPECT_EQ(run(options + "5", true), 0) << "it was told to stop before: " << said;
    EXPECT_EQ(run(options + "61", true), 1);
    EXPECT_TRUE(says("rings.fspack")) << said;
    EXPECT_EQ(run(options + "5"), 1) << "a person is told at once";
}

TEST_F(RunRefusals, ServiceFailsWithoutItsPoseFile) {
    std::filesystem::remove(folder / "poses.csv");
    EXPECT_EQ(run(usual, true), 1);
    EXPECT_TRUE(says("tracker.poses")) << said;
}

TEST_F(RunRefusals, NamesOutputThatCannotBeWritten) {
    std::filesystem::create_directories(folder / "out/poses.csv/in the way");
    EXPECT_EQ(run(std::string(usual) + "--out out"), 1);
    EXPECT_TRUE(says("out/poses.csv")) << said;
    EXPECT_TRUE(text("out.txt").empty()) << "it reports no success";
}

} // namespace
} // namespace frustumscreen::synthetic
