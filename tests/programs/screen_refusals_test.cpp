// The error of `frustumscreen render --output screen` when it cannot draw: one sentence, before a picture is written.

#include "tests/programs/program_folder.h"

#include <algorithm>
#include <string>
#include <vector>

namespace frustumscreen::programs {
namespace {

class ScreenRefusal : public ProgramFolder {
protected:
    void SetUp() override {
        put("poses.csv",
            "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n0,1,0,0,0,1,0,0,0,1\n0,2,0,-0.6,0.5,1,0,0,0,1\n");
        put("kiosk.toml", "[screen]\nroom = \"room.toml\"\nwidth = 64\nheight = 64\n");
        put("plain.toml", "[table]\n");
    }
    void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const {
        EXPECT_EQ(run("frustumscreen render --poses poses.csv --out out " + arguments), 1) << arguments;
        const std::string told = text("err.txt");
        EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
        for (const std::string& word : words) {
            EXPECT_NE(told.find(word), std::string::npos) << "'" << word << "' not in: " << told;
        }
        EXPECT_FALSE(std::filesystem::exists(folder / "out" / "frame_00000.png"));
    }
};

TEST_F(ScreenRefusal, NamesAMissingScreenOrPack) {
    expect_refused("--config plain.toml --output screen",
                   {"--output screen: the settings have no screen; add a table [screen] with its room"});
    expect_refused("--config plain.toml",
                   {"--pack is missing: the projector's pictures show a pack's artifact"});
    EXPECT_NE(run("frustumscreen render --poses poses.csv --out out --config kiosk.toml --output wall"), 0);
    EXPECT_NE(text("err.txt").find("prop"), std::string::npos);
}

TEST_F(ScreenRefusal, NamesTheFileAndLineOfARoomError) {
    expect_refused("--config kiosk.toml --output screen", {"room.toml: there is no such file"});
    put("room.toml", "[[object]]\npack = \"no.fspack\"\n");
    expect_refused("--config kiosk.toml --output screen", {"no.fspack: there is no such file"});
    put("room.toml", "[[object]]\npack = \"no.fspack\"\nsize_m = nan\n");
    expect_refused("--config kiosk.toml --output screen", {"room.toml:3: object[0].size_m is nan"});
    put("room.toml", "[[object]]\npack = \"poses.csv\"\n");
    expect_refused("--config kiosk.toml --output screen", {"poses.csv"});
    std::filesystem::remove(folder / "room.toml");
    std::filesystem::create_directory(folder / "room.toml");
    expect_refused("--config kiosk.toml --output screen", {"room.toml: this is a folder; name a file"});
}

} // namespace
} // namespace frustumscreen::programs
