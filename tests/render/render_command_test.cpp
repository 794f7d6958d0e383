// `frustumscreen render` end to end, on a pack made in memory.

#include "app/pack/pack_relief.h"
#include "tests/base/told.h"
#include "tests/folders.h"
#include "tests/programs/kiosk_folder.h"
#include "tests/render/rig.h"
#include "tests/render/ring_relief.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

namespace frustumscreen::synthetic {
namespace {

namespace fs = std::filesystem;

class RenderCommand : public KioskFolder {
protected:
    void SetUp() override {
        KioskFolder::SetUp();
        put("poses.csv", "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n"
                         "3000,1,0.02,0,0,1,0,0,0,1\n"
                         "1000,1,0,0,0,1,0,0,0,1\n"
                         "1000,2,0.3,-0.4,0.5,1,0,0,0,1\n"
                         "2000,1,0,0,0,1,0,0,0,0\n"
                         "3000,1,0.5,0,0,1,0,0,0,1\n");
    }
    int run(const std::string& arguments) const {
        return shell(fmt::format("'{}/frustumscreen' {} >out.txt 2>err.txt", bin_dir(), arguments));
    }
    image::Image8 picture(const std::string& name) const {
        return image::decode_png8(read_file(folder / name).value()).value();
    }
    std::string usual(const std::string& out) const {
        return fmt::format(
            "render --config '{}/config/near.toml' --pack rings.fspack --poses poses.csv --out {} ",
            source_dir(), out);
    }
};

TEST_F(RenderCommand, MakesAPictureForEveryTimeOfTheProp) {
    ASSERT_EQ(run(usual("a") + "--width 320 --height 200 --aov --no-light"), 0) << text("err.txt");
    EXPECT_TRUE(fs::exists(folder / "a/frame_00001.png"));
    EXPECT_TRUE(fs::exists(folder / "a/frame_00001.pfm"));
    EXPECT_FALSE(fs::exists(folder / "a/frame_00002.png"));
    const image::Image8 image = picture("a/frame_00000.png");
    EXPECT_EQ(image.width, 320);
    EXPECT_EQ(image.height, 200);
    EXPECT_GT(lit_pixels(image), 1000U);
    const std::string csv = text("a/frames.csv");
    EXPECT_EQ(csv.substr(0, csv.find('\n')), "frame,t_us,ms,technique,estimated_error_mm,p95_error_mm");
    EXPECT_NE(csv.find("\n0,1000,"), std::string::npos) << csv;
    EXPECT_NE(csv.find("\n1,3000,"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",level0,"), std::string::npos) << csv;
    EXPECT_TRUE(text("out.txt").empty());
    EXPECT_EQ(text("err.txt"), "");
}

TEST_F(RenderCommand, CastsTheReliefOfAPackThatHasOne) {
    EXPECT_EQ(run(usual("none") + "--technique relief"), 1);
    EXPECT_NE(text("err.txt").find("bake it again for relief"), std::string::npos) << text("err.txt");
    pack::Pack pack = rings();
    complete(pack);
    pack::put_reliefs(
        pack, std::vector<pack::MeasuredRelief>{{*relief_of(pack, 96), {1e-3F, 2e-3F, 3e-3F, 0.0F}},
                                                {*relief_of(pack, 192), {5e-4F, 1e-3F, 2e-3F, 0.0F}}});
    ASSERT_TRUE(write_file(folder / "rings.fspack", pack::write_pack(pack).value()));
    const std::string small = "--width 320 --height 200 ";
    ASSERT_EQ(run(usual("relief") + small + "--technique relief192 --aov"), 0) << text("err.txt");
    ASSERT_EQ(run(usual("gpu") + small + "--technique relief192-gpu --aov"), 0) << text("err.txt");
    ASSERT_EQ(run(usual("coarse") + small + "--technique relief"), 0) << text("err.txt");
    ASSERT_EQ(run(usual("large") + "--technique relief"), 0) << text("err.txt");
    ASSERT_EQ(run(usual("mesh") + small + "--technique level0"), 0) << text("err.txt");
    EXPECT_NE(text("relief/frames.csv").find(",relief192,"), std::string::npos) << text("relief/frames.csv");
    EXPECT_NE(text("coarse/frames.csv").find(",relief96,"), std::string::npos) << "a pixel is a texel";
    EXPECT_NE(text("large/frames.csv").find(",relief192,"), std::string::npos) << "of the 1280 in near.toml";
    EXPECT_TRUE(fs::exists(folder / "relief/frame_00001.pfm"));
    EXPECT_NE(text("gpu/frames.csv").find(",relief192-gpu,"), std::string::npos) << text("gpu/frames.csv");
    const image::Image8 mesh = picture("mesh/frame_00000.png");
    for (const char* way : {"relief", "gpu"}) {
        const image::Image8 relief = picture(fmt::format("{}/frame_00000.png", way));
        std::size_t off = 0;
        for (std::size_t k = 0; k < mesh.texels.size(); ++k) {
            const glm::ivec3 difference = glm::abs(glm::ivec3(relief.texels[k]) - glm::ivec3(mesh.texels[k]));
            off += std::max({difference.r, difference.g, difference.b}) > 32 ? 1U : 0U;
        }
        EXPECT_GT(lit_pixels(relief), 1000U) << way;
        EXPECT_LT(off, lit_pixels(mesh) / 10) << way << ": outlines and the texture's edges";
    }
    // And live, next to the caption.
    ASSERT_EQ(run("run --config kiosk.toml --headless --fast --seconds 2 --technique relief192 --out live "
                  "--stills 1 "
                  "--status-file status.json"),
              0)
        << text("err.txt");
    EXPECT_NE(text("status.json").find("\"level\": \"relief192\""), std::string::npos) << text("status.json");
    EXPECT_GT(lit_pixels(picture("live/frame_00000.png")), 1000U);
}

TEST_F(RenderCommand, ReportsPosesOffTheTable) {
    ASSERT_TRUE(write_file(folder / "poses.csv", as_bytes("t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n"
                                                          "1000,1,0.20,0,0,1,0,0,0,1\n"
                                                          "2000,1,20,0,0,1,0,0,0,1\n")));
    ASSERT_EQ(run(usual("a") + "--width 320 --height 200"), 0);
    EXPECT_EQ(text("err.txt"), "frustumscreen: in 1 of 2 poses the prop is off the table (0.404 x 0.252 m); "
                               "positions are metres\n");
}

TEST_F(RenderCommand, TheSameInputGivesTheSameBytes) {
    ASSERT_EQ(run(usual("a") + "--width 320 --height 200"), 0) << text("err.txt");
    ASSERT_EQ(run(usual("b") + "--width 320 --height 200 --technique level0"), 0) << text("err.txt");
    EXPECT_EQ(text("a/frame_00000.png"), text("b/frame_00000.png"));
    EXPECT_EQ(text("a/frame_00001.png"), text("b/frame_00001.png"));
}

TEST_F(RenderCommand, ShowsTheVisitorsView) {
    ASSERT_EQ(run(usual("v") + "--width 320 --height 200 --view visitor"), 0) << text("err.txt");
    EXPECT_GT(lit_pixels(picture("v/frame_00000.png")), 1000U);
    EXPECT_EQ(picture("v/frame_00000.png").width, 320);
    EXPECT_NE(text("v/visitor_cameras.json").find("table_from_camera"), std::string::npos);
    ASSERT_EQ(run(usual("half") + "--view visitor"), 0) << text("err.txt");
    EXPECT_EQ(picture("half/frame_00000.png").width, 640); // near.toml has 1280
}

TEST_F(RenderCommand, SheetAcceptsOnlyProjectorPictures) {
    const auto sheet = [&](const std::string& arguments) {
        const std::string command =
            fmt::format("'{}/frustumscreen-sheet' --config '{}/config/near.toml' {} -o sheet.png "
                        ">out.txt 2>err.txt",
                        bin_dir(), source_dir(), arguments);
        return shell(command) == 0 ? std::string() : text("err.txt");
    };
    EXPECT_TRUE(
        test::tells(sheet("--frames nowhere"), {"frustumscreen-sheet: nowhere: ", "[sheet.no_folder]\n"}));
    ASSERT_EQ(run(usual("v") + "--width 320 --height 200 --view visitor"), 0) << text("err.txt");
    EXPECT_EQ(sheet("--frames v --poses poses.csv").rfind("frustumscreen-sheet: v/visitor_cameras.json: ", 0),
              0U);
    ASSERT_EQ(run(usual("v") + "--width 320 --height 200"), 0) << text("err.txt");
    EXPECT_TRUE(
        test::tells(sheet("--frames v"), {"frustumscreen-sheet: v/poses.csv: ", "[sheet.no_pose_file]\n"}));
    EXPECT_EQ(sheet("--frames v --poses poses.csv"), "");
    EXPECT_TRUE(fs::exists(folder / "sheet.png"));
}

TEST_F(RenderCommand, ReportsFailuresInOneLine) {
    struct Case {
        std::string arguments;
        int status;
    };
    for (const Case& c :
         {Case{usual("x") + "--technique level7", 1}, Case{usual("x") + "--pack missing.fspack", 2},
          Case{usual("x") + "--width 100", 2}, Case{usual("x") + "--technique finst", 2}, Case{"render", 2},
          Case{"wobble", 2}, Case{"", 2},
          Case{"render --config none.toml --pack rings.fspack --poses poses.csv --out x", 1},
          Case{usual("poses.csv/x"), 1}}) {
        EXPECT_EQ(run(c.arguments), c.status) << c.arguments;
        if (c.status == 1) {
            const std::string error = text("err.txt");
            EXPECT_EQ(error.rfind("frustumscreen: ", 0), 0U) << error;
            EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
        }
    }
}

TEST_F(RenderCommand, HelpAndVersionExitWithZero) {
    EXPECT_EQ(run("render --help"), 0);
    EXPECT_NE(text("out.txt").find("--poses"), std::string::npos);
    EXPECT_EQ(run("--version"), 0);
    EXPECT_EQ(run("--help"), 0);
    EXPECT_EQ(run("render --version"), 0);
    EXPECT_EQ(text("out.txt").rfind("frustumscreen ", 0), 0U);
}

TEST_F(RenderCommand, NamesTheInvalidArgument) {
    const auto refusal = [&](const std::string& arguments) {
        EXPECT_EQ(run(arguments), 2) << arguments;
        const std::string error = text("err.txt");
        return error.substr(0, error.find('\n'));
    };
    EXPECT_EQ(refusal("--config kiosk.toml run"), "frustumscreen: write run before its options");
    for (const std::string technique : {"finst", "level", "level-1", "Auto", "level0x"}) {
        EXPECT_EQ(refusal("run --pattern --config kiosk.toml --technique " + technique),
                  "frustumscreen run: --technique: unknown technique '" + technique +
                      "'; allowed are auto, finest, level0, level1, ..., relief, "
                      "relief96, relief192, ..., relief-gpu, relief96-gpu, ...; frustumscreen run "
                      "--help says more");
    }
    for (const std::string seconds : {"8s", "0,5", "0", "nan", "1e9"}) {
        EXPECT_EQ(refusal("run --config kiosk.toml --seconds " + seconds),
                  "frustumscreen run: --seconds: '" + seconds +
                      "' is not allowed; allowed are 0.01 to 1000000 seconds, such as 8 or 0.5; "
                      "frustumscreen run --help says more");
    }
}

} // namespace
} // namespace frustumscreen::synthetic
