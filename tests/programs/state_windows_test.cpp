// `frustumscreen run` with a script of presses on a pack with states: a frozen window keeps what it shows while the lid opens in the
// prop; a live one opens with it; and then both show what the window of the state shows.
#include "app/image/image.h"
#include "app/pack/pack_file.h"
#include "tests/folders.h"
#include "tests/programs/opened_chest.h"
#include "tests/programs/program_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace frustumscreen::programs {
namespace {

/// Where two pictures differ.
struct Region {
    glm::ivec2 low{1 << 20}, high{-1};
    int pixels = 0;
};

class StateWindows : public ProgramFolder {
protected:
    void SetUp() override {
        static const pack::Pack pack = chest(world::Trigger::Button, false);
        ASSERT_TRUE(write_file(folder / "chest.fspack", pack::write_pack(pack).value()));
        put("still.csv", poses(false));
        put("lit.csv", poses(true));
    }
    /// A still prop. `torch`: from four seconds on, above it on the right, pointed at it: it is carried there, and moves as in a hand.
    [[nodiscard]] static std::string poses(bool torch) {
        std::string poses = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok\n";
        for (int k = 0; k < 140; ++k) {
            poses += fmt::format("{},1,0,0,0,1,0,0,0,1\n", 100'000 * k);
            if (torch && k >= 40) { // its z axis is down and to the left
                poses += fmt::format("{},3,0.16,{},0.36,0,0.97437,0,-0.22495,1\n", 100'000 * k,
                                     0.015 * std::max(50 - k, k % 2));
            }
        }
        return poses;
    }
    /// The picture after nine seconds. `windows`: keys of the settings; `presses`: button 6 pins, 5 opens the lid.
    [[nodiscard]] image::Image8 picture(const std::string& windows, const std::string& presses,
                                        bool torch = false) const {
        put("kiosk.toml",
            fmt::format(
                "[projector]\nwidth = 640\nheight = 400\nfx = 1000.0\nrefresh_hz = 20.0\n"
                "position_m = [0.0, 0.0, 0.9]\naim_m = [0.0, 0.0, 0.0]\n[prop]\nkind = \"solid\"\nfile = "
                "\"{}/config/prop_cube.obj\"\n[table]\nwidth_m = 0.576\ndepth_m = 0.36\n[tracker]\n"
                "kind = \"replay\"\nposes = \"{}.csv\"\n[eye]\ntracked = false\n[exhibit]\npacks = "
                "[\"chest.fspack\"]\ncaptions = false\ntable_pictures = false\nzone_frame = false\n"
                "guidance = false\n[windows]\nwidth_m = 0.09\ndepth_m = 0.09\n{}\n[panel]\nscript = [{}]\n",
                source_dir(), torch ? "lit" : "still",
                windows + (torch ? "\n[torch]\nsource = \"tracker\"" : ""), presses));
        EXPECT_EQ(
            run("frustumscreen run --config kiosk.toml --headless --fast --stills 4 --seconds 12 --out out"),
            0)
            << text("err.txt");
        return image::decode_png8(read_file(folder / "out/frame_00003.png").value()).value();
    }
    [[nodiscard]] static Region between(const image::Image8& a, const image::Image8& b) {
        Region region;
        for (int y = 0; y < a.height; ++y) {
            for (int x = 0; x < a.width; ++x) {
                if (a.at(x, y) != b.at(x, y)) {
                    region.low = glm::min(region.low, glm::ivec2(x, y));
                    region.high = glm::max(region.high, glm::ivec2(x, y));
                    ++region.pixels;
                }
            }
        }
        return region;
    }
    /// Pixels that differ within a region.
    [[nodiscard]] static int apart(const image::Image8& a, const image::Image8& b, const Region& in) {
        int apart = 0;
        for (int y = in.low.y; y <= in.high.y; ++y) {
            for (int x = in.low.x; x <= in.high.x; ++x) {
                apart += a.at(x, y) != b.at(x, y) ? 1 : 0;
            }
        }
        return apart;
    }
};

TEST_F(StateWindows, FrozenOnesStayLiveOnesMoveAndStatesMatchTheBehavioursEnd) {
    const std::string pin = "{ at_s = 1.0, button = 6 }", open = "{ at_s = 3.0, button = 5 }";
    const image::Image8 bare = picture("count = 1", "");
    const image::Image8 at_rest = picture("count = 1", pin);
    const Region window = between(bare, at_rest);
    ASSERT_GT(window.pixels, 500);
    const image::Image8 frozen = picture("count = 1", pin + ", " + open);
    EXPECT_EQ(apart(frozen, at_rest, window), 0) << "the lid has opened in the prop alone";
    EXPECT_GT(between(frozen, at_rest).pixels, 5) << "there it has";
    const image::Image8 live = picture("count = 1\nlive = true", pin + ", " + open);
    EXPECT_GT(apart(live, frozen, window), 100);
    EXPECT_EQ(between(live, frozen).pixels, apart(live, frozen, window)) << "the prop shows the same";
    const image::Image8 state = picture("count = 1", pin + ", { at_s = 4.0, button = 6 }");
    EXPECT_EQ(apart(state, live, window), 0) << "as the behaviour leaves it";
}

/// Rays say of such a window where the light falls (tests/render/window_light_test.cpp).
TEST_F(StateWindows, KeepTheTorchLightOfThePinnedProp) {
    const std::string pin = "{ at_s = 1.0, button = 6 }", open = "{ at_s = 2.0, button = 5 }";
    const std::string later = "{ at_s = 7.0, button = 6 }";
    const Region window = between(picture("count = 1", ""), picture("count = 1", pin));
    const image::Image8 unlit = picture("count = 1", pin + ", " + later);
    const image::Image8 opened = picture("count = 1", open + ", " + later, true);
    const image::Image8 state = picture("count = 1", pin + ", " + later, true);
    EXPECT_GT(apart(state, unlit, window), 300) << "the torch's light is in it";
    EXPECT_EQ(apart(state, opened, window), 0) << "as on the open lid that was pinned";
    const image::Image8 before = picture("count = 1", pin + ", { at_s = 3.0, button = 6 }", true);
    EXPECT_EQ(apart(before, unlit, window), 0) << "the torch came later";
}

} // namespace
} // namespace frustumscreen::programs
