// Without a screen, and for the projector's pictures beside one, nothing of a room is opened or read. The kernel is the witness:
// strace lists the files that a program opens.

#include "firmware_host/base/json.h"
#include "tests/programs/program_folder.h"

#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace frustumscreen::programs {
namespace {

class ScreenLeftOut : public ProgramFolder {
protected:
    void SetUp() override {
        write_star();
        ASSERT_EQ(run("frustumscreen-bake star.obj -o star.fspack --prop cube --unlit --size 64"), 0)
            << text("err.txt");
        std::filesystem::copy_file(folder / "star.fspack", folder / "room_star.fspack");
        put("room.toml", "[[object]]\npack = \"room_star.fspack\"\n");
        put("plain.toml", "[prop]\nkind = \"cube\"\nbase_m = 0.1\n");
        put("screen.toml", text("plain.toml") + "[screen]\nroom = \"room.toml\"\nwidth = 64\nheight = 64\n");
        put("poses.csv",
            "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n0,1,0,0,0,1,0,0,0,1\n0,2,0,-0.6,0.5,1,0,0,0,1\n");
    }
    /// The files of this folder that the program opens.
    [[nodiscard]] std::set<std::string> opened(const std::string& arguments) const {
        EXPECT_EQ(shell(fmt::format(
                      "strace -f -qq -e trace=open,openat,openat2 -o trace '{}'/frustumscreen {} >out.txt "
                      "2>err.txt",
                      bin_dir(), arguments)),
                  0)
            << text("err.txt");
        std::set<std::string> files;
        std::istringstream trace(text("trace"));
        static const std::regex own("\"(?:[^\"]*/)?([a-z_]+\\.(?:toml|fspack|csv))\"");
        for (std::string line; std::getline(trace, line);) {
            std::smatch match;
            if (std::regex_search(line, match, own)) {
                files.insert(match[1]);
            }
        }
        return files;
    }
};

using Files = std::set<std::string>;

TEST_F(ScreenLeftOut, TheProjectorsPicturesOpenNoFileOfARoom) {
    const std::string draw =
        "render --poses poses.csv --pack star.fspack --out out --width 64 --height 40 --config ";
    EXPECT_EQ(opened(draw + "plain.toml"), (Files{"plain.toml", "star.fspack", "poses.csv"}));
    EXPECT_EQ(opened(draw + "screen.toml"), (Files{"screen.toml", "star.fspack", "poses.csv"}));
}

TEST_F(ScreenLeftOut, TheScreensPicturesOpenNoPackOfTheProp) {
    put("screen.toml", text("screen.toml") + "[exhibit]\npacks = [\"star.fspack\"]\n");
    EXPECT_EQ(opened("render --poses poses.csv --output screen --out out --config screen.toml"),
              (Files{"screen.toml", "room.toml", "room_star.fspack", "poses.csv"}));
}

/// Shaders, bytes of GPU memory, devices and threads: what OpenGL and the program themselves say they have.
TEST_F(ScreenLeftOut, TheExhibitLoadsTheSameForTheProjectorBesideAScreen) {
    const auto loaded = [&](const std::string& settings) {
        EXPECT_EQ(run("frustumscreen plan --json --pack star.fspack --technique level0 --config " + settings),
                  0)
            << text("err.txt");
        nlohmann::json in = nlohmann::json::parse(text("out.txt")).at("in");
        in.erase("screen"); // says whether there is one
        return in;
    };
    const nlohmann::json plain = loaded("plain.toml");
    EXPECT_GT(plain.at("gpu_bytes"), 0);
    EXPECT_EQ(plain.at("planned_programs"), plain.at("programs"));
    EXPECT_EQ(loaded("screen.toml"), plain);
}

} // namespace
} // namespace frustumscreen::programs
