// `frustumscreen render --torch`: station 3 of a pose file is a light, wherever it is and whatever a file says of it.

#include "tests/base/told.h"
#include "tests/folders.h"
#include "tests/programs/kiosk_folder.h"
#include "tests/render/rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace frustumscreen::synthetic {
namespace {

constexpr const char* columns = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
constexpr const char* prop = "1000,1,0,0,0,1,0,0,0,1\n1000,2,0,-0.55,0.5,1,0,0,0,1\n";
// From the visitor's side, turned about +X by 120 degrees: +Z of the torch looks away from the visitor and down.
constexpr const char* lit = "1000,3,0,-0.3,0.2,0.5,-0.8660254,0,0,1\n";

class TorchCommand : public KioskFolder {
protected:
    void SetUp() override {
        KioskFolder::SetUp();
        put("poses.csv", std::string(columns) + prop + lit);
        put("dark.csv", std::string(columns) + prop);
    }
    int run(const std::string& more, const std::string& poses = "poses.csv",
            const std::string& out = "out") const {
        std::filesystem::remove_all(folder / out);
        return shell(fmt::format(
            "'{}/frustumscreen' render --config '{}/config/near.toml' --pack rings.fspack --poses {} "
            "--out {} --width 320 --height 200 {} >out.txt 2>err.txt",
            bin_dir(), source_dir(), poses, out, more));
    }
    std::string shown(const std::string& out = "out") const { return text(out + "/frame_00000.png"); }
    /// One line on standard error; returns it.
    std::string sentence() const {
        const std::string error = text("err.txt");
        EXPECT_EQ(error.rfind("frustumscreen", 0), 0U) << error;
        EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
        return error;
    }
};

TEST_F(TorchCommand, LightsWithStationThree) {
    ASSERT_EQ(run("", "dark.csv", "dark"), 0) << text("err.txt");
    ASSERT_EQ(run("", "poses.csv", "unlit"), 0) << text("err.txt");
    ASSERT_EQ(run("--torch white", "dark.csv", "none"), 0) << text("err.txt");
    ASSERT_EQ(run("--torch white", "poses.csv", "lit"), 0) << text("err.txt");
    ASSERT_EQ(run("--torch white", "poses.csv", "again"), 0) << text("err.txt");
    EXPECT_EQ(shown("unlit"), shown("dark")) << "without --torch station 3 is nothing";
    EXPECT_EQ(shown("none"), shown("dark")) << "without station 3 nothing is lit";
    EXPECT_EQ(shown("again"), shown("lit")) << "the same input gives the same bytes";
    const image::Image8 before =
        image::decode_png8(read_file(folder / "dark/frame_00000.png").value()).value();
    const image::Image8 after = image::decode_png8(read_file(folder / "lit/frame_00000.png").value()).value();
    std::size_t brighter = 0;
    for (std::size_t k = 0; k < before.texels.size(); ++k) {
        const glm::ivec4 more = glm::ivec4(after.texels[k]) - glm::ivec4(before.texels[k]);
        EXPECT_GE(std::min({more.r, more.g, more.b}), 0) << k;
        brighter += std::max({more.r, more.g, more.b}) > 0 ? 1U : 0U;
    }
    EXPECT_GT(brighter, 300U);
}

TEST_F(TorchCommand, RejectsAnUnknownTorchInOneLine) {
    EXPECT_EQ(run("--torch xray"), 1);
    EXPECT_NE(sentence().find("xray"), std::string::npos);
}

TEST_F(TorchCommand, RendersATorchAtAnyPlace) {
    ASSERT_EQ(run("", "dark.csv", "dark"), 0);
    struct Place {
        const char* row;
        bool dark;
    };
    for (const Place& place :
         {Place{"1000,3,0,0,0.06,1,0,0,0,1\n", true},          // in the prop, straight up, past the rings
          Place{"1000,3,0,0,0,1,0,0,0,1\n", false},            // in the prop's bottom
          Place{"1000,3,0,-0.55,0.5,0.4,-0.9,0,0,1\n", false}, // at the eye
          Place{"1000,3,0,0,0.9,0,1,0,0,1\n", false},          // at the projector
          Place{"1000,3,0,0,-0.5,1,0,0,0,1\n", false},         // under the table
          Place{"1000,3,0,-0.3,0.2,0.5e-5,-0.8660254e-5,0,0,1\n", false}, // a short quaternion
          Place{"1000,3,0,0,1000,0,1,0,0,1\n", true},                     // a thousand metres away
          Place{"1000,3,700,-700,5,0,1,0,0,1\n", true},                   // beside everything
          Place{"1000,3,0,-0.3,0.2,0.5,0.8660254,0,0,1\n", true},         // looks away
          Place{"1000,3,0,-0.3,0.2,0.5,-0.8660254,0,0,0\n", true},        // not ok
          Place{"999,3,0,-0.3,0.2,0.5,-0.8660254,0,0,1\n", true}}) {      // of another time
        put("poses.csv", std::string(columns) + prop + place.row);
        ASSERT_EQ(run("--torch white"), 0) << place.row << text("err.txt");
        ASSERT_FALSE(shown().empty()) << place.row;
        EXPECT_EQ(shown() == shown("dark"), place.dark) << place.row;
    }
}

TEST_F(TorchCommand, RejectsInvalidTorchPosesInOneLine) {
    for (const char* row :
         {"1000,3,nan,0,0.2,1,0,0,0,1\n", "1000,3,0,inf,0.2,1,0,0,0,1\n", "1000,3,0,0,0.2,0,0,0,0,1\n",
          "1000,3,0,0,0.2,nan,0,0,1,1\n", "1000,3,0,0,0.2,1,0,0\n", "1000,3,1e30,0,0.2,1,0,0,0,1\n",
          "1000,3,0,0,0.2,1,0,0,0,yes\n", "1000,4,0,0,0.2,1,0,0,0,1\n"}) {
        put("poses.csv", std::string(columns) + prop + row);
        EXPECT_EQ(run("--torch white"), 1) << row;
        EXPECT_NE(sentence().find("poses.csv"), std::string::npos) << row;
    }
}

} // namespace
} // namespace frustumscreen::synthetic
