// `frustumscreen render --eye`: one eye's picture is that of a head moved by half of the interocular distance, and a layout
// holds both eyes' pictures.

#include "app/pack/pack_relief.h"
#include "tests/base/told.h"
#include "tests/programs/kiosk_folder.h"
#include "tests/render/ring_relief.h"
#include "tests/render/stereo_rig.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::synthetic {
namespace {

constexpr double interocular_mm = 61.0;
constexpr int width = 320;
constexpr int height = 200;
constexpr int poses = 3;

/// A head: where its middle is, and its own x axis and turn.
struct Head {
    glm::dvec3 middle_m;
    glm::dvec3 right;
    const char* turn; ///< w, x, y, z
};
// Turned about each axis, by angles whose axes are plain: not at all, by 90 degrees to the left, and rolled by 36.87.
const std::array<Head, poses> heads{{{{0.1, -0.5, 0.45}, {1.0, 0.0, 0.0}, "1,0,0,0"},
                                     {{0.45, 0.05, 0.4}, {0.0, 1.0, 0.0}, "1,0,0,1"},
                                     {{-0.2, -0.35, 0.55}, {0.8, 0.0, -0.6}, "3,0,1,0"}}};

class EyeCommand : public KioskFolder {
protected:
    void SetUp() override {
        KioskFolder::SetUp();
        pack::Pack pack = rings();
        complete(pack);
        pack::put_reliefs(
            pack, std::vector<pack::MeasuredRelief>{{*relief_of(pack, 96), {1e-3F, 2e-3F, 3e-3F, 0.0F}}});
        ASSERT_TRUE(write_file(folder / "rings.fspack", pack::write_pack(pack).value()));
        put_heads("poses.csv", 0.0);
        put_heads("left.csv", -1.0);
        put_heads("right.csv", 1.0);
        for (const char* stereo : {"off", "side_by_side", "top_bottom", "frame_sequential", "anaglyph"}) {
            put(std::string(stereo) + ".toml",
                fmt::format("[projector]\nwidth = {}\nheight = {}\nfx = 712.5\nposition_m = [0.0, 0.0, 0.9]\n"
                            "aim_m = [0.0, 0.0, 0.0]\n[prop]\nbase_m = 0.16\ntop_m = 0.09\nheight_m = 0.12\n"
                            "[table]\nwidth_m = 0.404\ndepth_m = 0.252\n"
                            "[eye]\nstereo = \"{}\"\ninterocular_mm = {:.1f}\n",
                            width, height, stereo, interocular_mm));
        }
    }
    /// Heads moved to the side of one eye, and turned no more where they are moved.
    void put_heads(const std::string& file, double side) const {
        std::string text = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
        for (int k = 0; k < poses; ++k) {
            const Head& head = heads[static_cast<std::size_t>(k)];
            const glm::dvec3 at = head.middle_m + side * 0.5e-3 * interocular_mm * head.right;
            text += fmt::format("{0},1,{1},{2},0,{3},0,0,{4},1\n{0},2,{5},{6},{7},{8},1\n", k * 1000,
                                0.01 * k, -0.005 * k, std::cos(0.4 * k), std::sin(0.4 * k), at.x, at.y, at.z,
                                side == 0.0 ? head.turn : "1,0,0,0");
        }
        put(file, text);
    }
    /// Draws into the folder `out`; returns the exit status.
    int render(const std::string& settings, const std::string& poses_file, const std::string& out,
               const std::string& more) const {
        return run(fmt::format(
            "frustumscreen render --config {}.toml --pack rings.fspack --poses {}.csv --out {} {}", settings,
            poses_file, out, more));
    }
    [[nodiscard]] image::Image8 picture(const std::string& out, int k) const {
        return image::decode_png8(read_file(folder / fmt::format("{}/frame_{:05}.png", out, k)).value())
            .value();
    }
    void expect_same_files(const std::string& a, const std::string& b, const std::string& ending) const {
        for (int k = 0; k < poses; ++k) {
            const std::string name = fmt::format("frame_{:05}.{}", k, ending);
            EXPECT_TRUE(text(a + "/" + name) == text(b + "/" + name)) << a << ' ' << name;
            EXPECT_FALSE(text(a + "/" + name).empty());
        }
    }
};

TEST_F(EyeCommand, EyePictureEqualsThatOfAHeadMovedSideways) {
    for (const char* technique : {"level0", "relief96", "relief96-gpu"}) {
        for (const char* light : {"", "--no-light --aov"}) {
            const std::string options = fmt::format("--technique {} {}", technique, light);
            for (const std::string eye : {"left", "right"}) {
                ASSERT_EQ(render("off", eye, "moved", options), 0) << text("err.txt");
                ASSERT_EQ(render("side_by_side", "poses", "eye", options + " --eye " + eye), 0)
                    << text("err.txt");
                EXPECT_EQ(text("err.txt"), "");
                EXPECT_GT(lit_pixels(picture("eye", 1)), 500U);
                expect_same_files("eye", "moved", "png");
                if (*light != '\0') {
                    expect_same_files("eye", "moved", "pfm");
                }
            }
        }
    }
}

/// A designer may look at the eyes before the projector can show them.
TEST_F(EyeCommand, AnEyeIsDrawnWhereStereoIsOffToo) {
    ASSERT_EQ(render("off", "poses", "off", "--eye left"), 0) << text("err.txt");
    ASSERT_EQ(render("anaglyph", "poses", "on", "--eye left"), 0) << text("err.txt");
    expect_same_files("on", "off", "png");
    ASSERT_EQ(render("off", "poses", "middle", ""), 0) << text("err.txt");
    EXPECT_NE(text("middle/frame_00000.png"), text("off/frame_00000.png"));
    ASSERT_EQ(render("off", "left", "view_moved", "--view visitor"), 0) << text("err.txt");
    ASSERT_EQ(render("off", "poses", "view", "--view visitor --eye left"), 0) << text("err.txt");
    expect_same_files("view", "view_moved", "png");
}

TEST_F(EyeCommand, ALayoutHoldsBothEyesPictures) {
    struct Case {
        settings::Stereo stereo;
        std::string size;   ///< of one eye's picture
        glm::ivec2 whole{}; ///< of the layout's
    };
    for (const Case& c : {Case{settings::Stereo::SideBySide, "--width 160 --height 200", {320, 200}},
                          Case{settings::Stereo::TopBottom, "--width 320 --height 100", {320, 200}},
                          Case{settings::Stereo::FrameSequential, "", {320, 400}},
                          Case{settings::Stereo::Anaglyph, "", {320, 200}}}) {
        const std::string name(settings::name_of(c.stereo));
        for (const char* technique : {"level0", "relief96"}) {
            // Both eyes dim together, so that each alone may be brighter: unlit they are the same.
            const std::string options = fmt::format("--technique {} --no-light ", technique);
            ASSERT_EQ(render(name, "poses", "both", options), 0) << text("err.txt");
            ASSERT_EQ(render(name, "poses", "asked", options + "--eye both"), 0) << text("err.txt");
            expect_same_files("both", "asked", "png");
            for (const char* eye : {"left", "right"}) {
                ASSERT_EQ(render("off", "poses", eye, options + c.size + " --eye " + eye), 0)
                    << text("err.txt");
            }
            const geometry::Pinhole projector{.width = width, .height = height};
            const scene::StereoLayout layout = scene::stereo_layout(projector, c.stereo);
            for (int k = 0; k < poses; ++k) {
                const image::Image8 both = picture("both", k);
                EXPECT_EQ(glm::ivec2(both.width, both.height), c.whole) << name;
                for (std::size_t eye = 0; eye < 2; ++eye) {
                    const glm::bvec3& channels = layout.pictures[eye].channels;
                    const Difference found =
                        difference(coloured(picture(eye == 0 ? "left" : "right", k), channels),
                                   coloured(seen_by(eye, layout, both), channels));
                    EXPECT_GT(found.lit, 500U) << name;
                    EXPECT_EQ(found.pixels, 0U) << name << ' ' << technique << ", eye " << eye
                                                << ": by up to " << found.worst << " codes";
                }
            }
        }
    }
}

TEST_F(EyeCommand, RejectsInvalidCombinationsOfEyeOptions) {
    EXPECT_EQ(render("off", "poses", "x", "--eye both"), 1);
    EXPECT_TRUE(
        test::tells(text("err.txt"), {"frustumscreen: --eye both: ", "eye.stereo", "[render.no_stereo]\n"}));
    for (const char* more : {"--aov", "--view visitor", "--eye both --aov", "--eye both --view visitor"}) {
        EXPECT_EQ(render("anaglyph", "poses", "x", more), 1) << more;
        EXPECT_TRUE(test::tells(text("err.txt"), {"frustumscreen: ", "--eye left", "[render.one_eye]\n"}))
            << more;
    }
    EXPECT_EQ(render("anaglyph", "poses", "x", "--eye middle"), 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "x"));
}

} // namespace
} // namespace frustumscreen::synthetic
