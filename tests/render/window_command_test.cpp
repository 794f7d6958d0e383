// `frustumscreen render --pin`: all pictures show the first pose's view as a window on the table, and the prop's pixels stay the same.

#include "app/settings/settings.h"
#include "tests/folders.h"
#include "tests/programs/kiosk_folder.h"
#include "tests/render/rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

namespace frustumscreen::synthetic {
namespace {

class PinCommand : public KioskFolder {
protected:
    settings::CheckedSettings settings =
        settings::load_settings(std::filesystem::path(source_dir()) / "config/near.toml").value();

    void SetUp() override {
        KioskFolder::SetUp();
        put("poses.csv", "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n"
                         "1000,1,0,0,0,1,0,0,0,1\n1000,2,0,-0.55,0.5,1,0,0,0,1\n"
                         "2000,1,0.01,0,0,1,0,0,0,1\n2000,2,0.4,-0.3,0.5,1,0,0,0,1\n");
        put("below.csv", "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n"
                         "1000,1,0,0,0,1,0,0,0,1\n1000,2,0,-0.55,-0.1,1,0,0,0,1\n");
    }
    int run(const std::string& more, const std::string& out = "out",
            const std::string& poses = "poses.csv") const {
        std::filesystem::remove_all(folder / out);
        return shell(
            fmt::format("'{}/frustumscreen' render --config '{}/config/near.toml' --pack rings.fspack "
                        "--poses {} --out {} --width 320 --height 200 {} >out.txt 2>err.txt",
                        bin_dir(), source_dir(), poses, out, more));
    }
    image::Image8 picture(const std::string& out, int frame) const {
        const auto file = folder / out / fmt::format("frame_{:05}.png", frame);
        return image::decode_png8(read_file(file).value()).value();
    }
    /// Whether the projector's pixel meets the prop.
    bool is_prop(int x, int y, double prop_x_m) const {
        const geometry::Pinhole pinhole = settings->projector.pinhole.scaled_to(320, 200);
        const geometry::RigidTransform& table_from_projector = settings->projector.table_from_projector;
        geometry::PropHit hit;
        return geometry::enter(settings::make_prop(settings->prop),
                               table_from_projector.translation - glm::dvec3(prop_x_m, 0.0, 0.0),
                               table_from_projector.direction(pinhole.ray({x + 0.5, y + 0.5})), hit);
    }
};

TEST_F(PinCommand, PinsWhatTheFirstPoseShows) {
    ASSERT_EQ(run("", "plain"), 0) << text("err.txt");
    ASSERT_EQ(run("--pin 0.15,0 --pin -0.15,0,30", "pinned"), 0) << text("err.txt");
    ASSERT_EQ(run("--pin 0.15,0 --pin -0.15,0,30", "again"), 0) << text("err.txt");
    for (const int frame : {0, 1}) {
        const image::Image8 plain = picture("plain", frame);
        const image::Image8 pinned = picture("pinned", frame);
        EXPECT_EQ(pinned.texels, picture("again", frame).texels) << "the same input gives the same bytes";
        std::size_t left = 0;
        std::size_t right = 0;
        std::size_t prop = 0;
        for (int y = 0; y < plain.height; ++y) {
            for (int x = 0; x < plain.width; ++x) {
                if (is_prop(x, y, 0.01 * frame)) {
                    ++prop;
                    EXPECT_EQ(plain.at(x, y), pinned.at(x, y)) << x << ' ' << y;
                } else if (plain.at(x, y) != pinned.at(x, y)) {
                    ++(x < plain.width / 2 ? left : right);
                }
            }
        }
        EXPECT_GT(prop, 5000U);
        EXPECT_GT(left, 100U) << frame;
        EXPECT_GT(right, 100U) << frame;
    }
}

/// Whether a lit pixel of `picture` is lit in `other` there or in a pixel around.
bool is_lit_around(const image::Image8& picture, const image::Image8& other, int x, int y) {
    const auto is_lit = [](const image::Image8& of, int i, int j) {
        return glm::u8vec3(of.at(i, j)) != glm::u8vec3(0);
    };
    bool around = !is_lit(picture, x, y);
    for (int j = std::max(0, y - 1); j <= std::min(y + 1, other.height - 1); ++j) {
        for (int i = std::max(0, x - 1); i <= std::min(x + 1, other.width - 1); ++i) {
            around = around || is_lit(other, i, j);
        }
    }
    return around;
}

/// Patches instead of geometry: no outline moves by more than a pixel, and nothing else changes.
TEST_F(PinCommand, PatchesShowWhatGeometryShows) {
    const std::string pins = "--pin 0.15,0 --pin -0.15,0,30 --windows ";
    ASSERT_EQ(run(pins + "geometry", "geometry"), 0) << text("err.txt");
    ASSERT_EQ(run(pins + "patches", "patches"), 0) << text("err.txt");
    ASSERT_EQ(run(pins + "patches", "again"), 0) << text("err.txt");
    for (const int frame : {0, 1}) {
        const image::Image8 geometry = picture("geometry", frame);
        const image::Image8 patches = picture("patches", frame);
        EXPECT_EQ(patches.texels, picture("again", frame).texels);
        std::size_t lit = 0;
        std::size_t other = 0;
        std::size_t moved = 0;
        for (int y = 0; y < geometry.height; ++y) {
            for (int x = 0; x < geometry.width; ++x) {
                if (is_prop(x, y, 0.01 * frame)) {
                    EXPECT_EQ(geometry.at(x, y), patches.at(x, y)) << x << ' ' << y;
                    continue;
                }
                lit += glm::u8vec3(patches.at(x, y)) != glm::u8vec3(0) ? 1U : 0U;
                other += geometry.at(x, y) != patches.at(x, y) ? 1U : 0U;
                moved += is_lit_around(patches, geometry, x, y) && is_lit_around(geometry, patches, x, y)
                             ? 0U
                             : 1U;
            }
        }
        std::printf("frame %d: %zu of %zu lit pixels are beyond a pixel\n", frame, moved, lit);
        EXPECT_GT(lit, 200U);
        EXPECT_GT(other, 20U) << "patches were drawn";
        EXPECT_LE(moved, lit / 200);
    }
    EXPECT_EQ(run(pins + "points"), 2);
}

/// The first pose has a torch, at the visitor's side, that points at the prop; the second has none.
TEST_F(PinCommand, WindowsKeepTheTorchsLightOfTheFirstPose) {
    std::string poses = text("poses.csv");
    poses.insert(poses.find("2000,"), "1000,3,0,-0.3,0.2,0.5,-0.8660254,0,0,1\n");
    put("lit.csv", poses);
    const std::string pins = "--pin 0.15,0 --pin -0.15,0,30 ";
    ASSERT_EQ(run(pins, "unlit", "lit.csv"), 0) << text("err.txt");
    ASSERT_EQ(run(pins + "--torch white", "lit", "lit.csv"), 0) << text("err.txt");
    for (const int frame : {0, 1}) {
        const image::Image8 unlit = picture("unlit", frame);
        const image::Image8 lit = picture("lit", frame);
        std::size_t prop = 0;
        std::size_t left = 0;
        std::size_t right = 0;
        for (int y = 0; y < unlit.height; ++y) {
            for (int x = 0; x < unlit.width; ++x) {
                EXPECT_GE(lit.at(x, y).r, unlit.at(x, y).r) << x << ' ' << y;
                if (lit.at(x, y) != unlit.at(x, y)) {
                    ++(is_prop(x, y, 0.01 * frame) ? prop : x < unlit.width / 2 ? left : right);
                }
            }
        }
        EXPECT_EQ(prop > 300, frame == 0) << prop;
        EXPECT_GT(left, 30U) << frame;
        EXPECT_GT(right, 30U) << frame;
    }
}

TEST_F(PinCommand, RejectsInvalidPinsInOneLine) {
    for (const char* const pin : {"0.1", "0.1,x", "0.1,0.2,30,4", "1e9,0", "nan,0", "0.1,0.2,400", "''"}) {
        EXPECT_EQ(run(fmt::format("--pin {}", pin)), 2) << pin;
        const std::string error = text("err.txt");
        EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
    }
    EXPECT_EQ(run("--pin 0,0 --pin 0,0 --pin 0,0 --pin 0,0 --pin 0,0 --pin 0,0 --pin 0,0"), 1);
    EXPECT_NE(text("err.txt").find("7 windows"), std::string::npos) << text("err.txt");
    EXPECT_EQ(run("--pin 0.1,0", "out", "below.csv"), 1);
    EXPECT_NE(text("err.txt").find("above"), std::string::npos) << text("err.txt");
}

} // namespace
} // namespace frustumscreen::synthetic
