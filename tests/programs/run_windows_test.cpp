// `frustumscreen run` with a script that presses the seventh button: a window is seen on the table, of the settings' size, beside the
// prop, with the artifact in it. Without [windows] there is no window.
#include "app/geometry/table_plane.h"
#include "app/image/image.h"
#include "app/settings/settings.h"
#include "app/typography/captions.h"
#include "firmware_host/base/json.h"
#include "tests/folders.h"
#include "tests/programs/kiosk_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace frustumscreen::synthetic {
namespace {

/// All that is lit is the artifact; a still hand.
constexpr const char* bare = "captions = false\ntable_pictures = false\nzone_frame = false\nguidance = "
                             "false\n[eye]\ntracked = false\n";
constexpr double side_m = 0.12;

std::string windows_of(const std::string& script) {
    return fmt::format("[windows]\ncount = 2\nwidth_m = {0}\ndepth_m = {0}\n[panel]\nscript = [{1}]\n",
                       side_m, script);
}

/// The pixels of a picture that differ from another one.
struct Change {
    int pixels = 0;   ///< that are brighter
    int coloured = 0; ///< of these, not grey as the window's frame is
    int covered = 0;  ///< that were lit before
    /// Mostly of the windows' frames, which are alike in size; the artifact is larger in some than in others.
    [[nodiscard]] int grey() const { return pixels - coloured; }
    glm::ivec2 low{1 << 20}, high{-1};
};

class RunWindows : public KioskFolder {
protected:
    /// `moves_at_s`: the prop is 0.02 m farther to the right from then on.
    void put_poses(const std::vector<double>& moves_at_s = {}) const {
        std::string text = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
        for (int k = 0; k < 120; ++k) {
            const auto moves = std::count_if(moves_at_s.begin(), moves_at_s.end(),
                                             [&](double at_s) { return 0.05 * k >= at_s; });
            text += fmt::format("{},1,{:.2f},0,0,1,0,0,0,1\n", 50'000 * k, 0.02 * static_cast<double>(moves));
        }
        put("poses.csv", text);
    }
    void run(const std::string& into, double seconds) const {
        const int status =
            shell(fmt::format("rm -rf {0}; '{1}/frustumscreen' run --config kiosk.toml --headless --fast "
                              "--json --out {0} --stills 4 --seconds {2} >out.json 2>err.txt",
                              into, bin_dir(), seconds));
        EXPECT_EQ(status, 0) << text("err.txt");
    }
    [[nodiscard]] image::Image8 picture(const std::string& name) const {
        return image::decode_png8(read_file(folder / name).value()).value();
    }
    [[nodiscard]] Change change(const std::string& name) const {
        const image::Image8 before = picture("without/" + name), after = picture("with/" + name);
        Change change;
        for (int y = 0; y < before.height; ++y) {
            for (int x = 0; x < before.width; ++x) {
                const auto sum = [&](const image::Image8& of) {
                    const glm::ivec3 pixel(of.at(x, y));
                    return pixel.x + pixel.y + pixel.z;
                };
                if (sum(before) == sum(after)) {
                    continue;
                }
                ++change.pixels;
                const glm::ivec3 pixel(after.at(x, y));
                change.coloured +=
                    std::max({pixel.x, pixel.y, pixel.z}) - std::min({pixel.x, pixel.y, pixel.z}) > 20 ? 1
                                                                                                       : 0;
                change.covered += sum(before) > 0 ? 1 : 0;
                change.low = glm::min(change.low, glm::ivec2(x, y));
                change.high = glm::max(change.high, glm::ivec2(x + 1, y + 1));
            }
        }
        return change;
    }
};

TEST_F(RunWindows, APressPinsAWindowOfTheSettingsSizeBesideTheProp) {
    put_poses();
    write_settings("replay", bare);
    run("without", 5.0);
    write_settings("replay", bare + windows_of("{ at_s = 2.0, button = 6 }"));
    run("with", 5.0);
    EXPECT_EQ(change("frame_00000.png").pixels, 0) << "nothing is pinned yet";
    const Change pinned = change("frame_00003.png");
    ASSERT_GT(pinned.pixels, 200);
    EXPECT_EQ(pinned.covered, 0) << "it lies where nothing else is seen";
    EXPECT_GT(pinned.coloured, 50) << "the artifact is in it";

    const settings::Settings usual = *settings::load_settings(folder / "kiosk.toml").value();
    const auto at = [&](double x, double y) {
        return geometry::lights_table(usual.projector.pinhole, usual.projector.table_from_projector, {x, y})
            .value();
    };
    const glm::dvec2 a = at(pinned.low.x, pinned.high.y), b = at(pinned.high.x, pinned.low.y);
    const glm::dvec2 size = glm::abs(b - a), middle = 0.5 * (a + b);
    const double pixel_m = glm::distance(at(161.0, 100.0), at(160.0, 100.0));
    EXPECT_NEAR(size.x, side_m + 2.6 * pixel_m, 2.0 * pixel_m); // with its frame
    EXPECT_NEAR(size.y, side_m + 2.6 * pixel_m, 2.0 * pixel_m);
    const auto shadow = typography::hidden_by_prop(settings::make_prop(usual.prop), {},
                                                   usual.projector.table_from_projector.translation);
    const double clear =
        typography::clearance(typography::TableRectangle{middle, size}.corners(), shadow.value().corners());
    EXPECT_GE(clear, 0.02 - 2.0 * pixel_m);
}

TEST_F(RunWindows, PinsAtMostTwoWindowsWithoutOverlap) {
    put_poses({0.9, 2.1}); // where the prop stays, a press pins a state of the artifact
    write_settings("replay", bare);
    run("without", 5.9);
    write_settings("replay", bare + windows_of("{ at_s = 0.3, button = 6 }, { at_s = 2.8, button = 6 }"));
    run("with", 5.9);
    const Change first = change("frame_00001.png"), both = change("frame_00003.png");
    ASSERT_GT(first.pixels, 200);
    EXPECT_GT(both.coloured, 16 * first.coloured / 10);
    EXPECT_NEAR(both.grey(), 2 * first.grey(), first.grey() / 3);
    write_settings(
        "replay",
        bare +
            windows_of("{ at_s = 0.3, button = 6 }, { at_s = 1.5, button = 6 }, { at_s = 2.7, button = 6 }"));
    run("with", 5.9);
    const Change three = change("frame_00003.png");
    EXPECT_GT(three.coloured, 16 * first.coloured / 10);
    EXPECT_NEAR(three.grey(), 2 * first.grey(), first.grey() / 3) << "the oldest went";
}

/// Counts programs, bytes of GPU memory, devices and threads, as OpenGL and the program report them.
TEST_F(RunWindows, LoadsNothingWithoutWindows) {
    const auto loaded = [&](const std::string& more) {
        write_settings("simulated", more);
        EXPECT_EQ(
            shell(fmt::format(
                "'{}/frustumscreen' plan --json --config kiosk.toml --pack rings.fspack >out.json 2>err.txt",
                bin_dir())),
            0)
            << text("err.txt");
        return nlohmann::json::parse(text("out.json"));
    };
    const nlohmann::json none = loaded("");
    const nlohmann::json kept = loaded("[windows]\nwidth_m = 0.1\n");
    EXPECT_EQ(none.at("in"), kept.at("in"));
    const nlohmann::json with = loaded("[windows]\ncount = 2\n");
    EXPECT_EQ(with.at("in").at("planned_programs"), with.at("in").at("programs"));
    EXPECT_GE(with.at("in").at("gpu_bytes"), none.at("in").at("gpu_bytes"));
}

} // namespace
} // namespace frustumscreen::synthetic
