// The safe picture on a model of the kernel's mode setting: each pixel on the screen, cables, other programs,
// and each call failing.
#include "app/programs/safe/safe_screen.h"
#include "app/safe/draw_safe_page.h"
#include "tests/display/fake_desk.h"

#include <cstring>

namespace frustumscreen::safe {
namespace {

using std::chrono::minutes;

/// `GetParam`: whether the driver has atomic commits.
class SafeOnCard : public display::Desk, public testing::WithParamInterface<bool> {
protected:
    SafeOnCard() { desk.card.atomic = GetParam(); }

    [[nodiscard]] std::vector<std::uint32_t> on_screen() const {
        const std::optional<display::FakeCard::Shown> shown = desk.card.shown(desk.hdmi);
        if (!shown) {
            return {};
        }
        const std::span<const std::byte> bytes = desk.card.pixels(shown->framebuffer);
        const std::size_t rows = shown->mode.vdisplay;
        const std::size_t columns = shown->mode.hdisplay;
        std::vector<std::uint32_t> pixels(rows * columns);
        for (std::size_t y = 0; y < rows; ++y) {
            std::memcpy(&pixels[y * columns], &bytes[y * (bytes.size() / rows)], 4 * columns);
        }
        return pixels;
    }
};
INSTANTIATE_TEST_SUITE_P(Safe, SafeOnCard, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "Atomic" : "Legacy"; });

/// The whole page drawn at once; tests/safe/safe_words_test.cpp compares its letters with Pango's.
std::vector<std::uint32_t> page(int width, int height, const SafeText& text) {
    std::vector<std::uint8_t> greys(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    draw_safe_rows(lay_out_safe_page(width, height, text, safe_languages()), 0, greys);
    std::vector<std::uint32_t> pixels;
    for (const std::uint8_t grey : greys) {
        pixels.push_back(grey * 0x010101U);
    }
    return pixels;
}

/// Removes the code from the corner: grey 4 is a 1, grey 3 a 0; returns 256 if there is none.
unsigned take_code(std::vector<std::uint32_t>& pixels) {
    unsigned code = 0;
    for (unsigned k = 0; k < 8; ++k) {
        if (pixels[k] != 0x030303 && pixels[k] != 0x040404) {
            return 256;
        }
        code |= (pixels[k] == 0x040404 ? 1U : 0U) << k;
        pixels[k] = 0;
    }
    return code;
}

TEST_P(SafeOnCard, ShowsThePageOfEachTextWithANewCode) {
    const auto screen = programs::SafeScreen::open(display::card_path, safe_languages());
    ASSERT_TRUE(screen) << screen.error().message;
    std::set<unsigned> codes;
    for (int k = 0; k < 6; ++k) {
        const SafeText text{k < 3 ? "The disk is full." : "", minutes(k)};
        ASSERT_TRUE((*screen)->show(text).value_or(false)) << (*screen)->state();
        std::vector<std::uint32_t> pixels = on_screen();
        ASSERT_EQ(pixels.size(), 320U * 200U);
        const unsigned code = take_code(pixels);
        EXPECT_LT(code, 256U) << k;
        EXPECT_TRUE(codes.insert(code).second) << "the same code in picture " << k;
        EXPECT_EQ(pixels, page(320, 200, text)) << k;
        EXPECT_GT(std::count_if(pixels.begin(), pixels.end(), [](std::uint32_t pixel) { return pixel != 0; }),
                  500);
    }
    EXPECT_EQ(desk.card.removed_while_shown(), 0);
}

TEST_P(SafeOnCard, FollowsUnplugAndReplugOfAProjector) {
    const auto screen = programs::SafeScreen::open(display::card_path, safe_languages());
    ASSERT_TRUE(screen) << screen.error().message;
    ASSERT_TRUE((*screen)->show({}).value_or(false));
    desk.card.unplug(desk.hdmi);
    for (int k = 0; k < 10; ++k) { // it queries the projector at each tenth picture
        ASSERT_TRUE((*screen)->show({}));
    }
    EXPECT_FALSE((*screen)->lit());
    EXPECT_FALSE((*screen)->show({}).value());
    EXPECT_NE((*screen)->state().find("no projector is connected"), std::string_view::npos)
        << (*screen)->state();
    EXPECT_TRUE(on_screen().empty());
    desk.card.plug(desk.hdmi, {display::kernel_mode(256, 192, 60.0, true)});
    ASSERT_TRUE((*screen)->show({"Again.", minutes(1)}).value_or(false)) << (*screen)->state();
    std::vector<std::uint32_t> pixels = on_screen();
    ASSERT_EQ(pixels.size(), 256U * 192U);
    take_code(pixels);
    EXPECT_EQ(pixels, page(256, 192, {"Again.", minutes(1)}));
}

TEST_P(SafeOnCard, RefusesAScreenHeldByAnotherProgram) {
    const int other = kernel.open_file(&desk.card, nullptr, 0);
    ASSERT_EQ(desk.card.become_master(*kernel.file(other)), 0);
    const auto screen = programs::SafeScreen::open(display::card_path, safe_languages());
    ASSERT_FALSE(screen);
    EXPECT_EQ(screen.error().kind, ErrorKind::DeviceLost) << "it may end";
    EXPECT_EQ(screen.error().id, "safe.screen_held") << screen.error().message;
    kernel.close_file(other);
}

TEST_P(SafeOnCard, ReportsACardWithoutMemory) {
    kernel.fail_always("drmModeCreateDumbBuffer", ENOSYS);
    const auto screen = programs::SafeScreen::open(display::card_path, safe_languages());
    ASSERT_TRUE(screen) << screen.error().message;
    EXPECT_FALSE((*screen)->show({}).value());
    EXPECT_NE((*screen)->state().find("the graphics card has no memory for "), std::string_view::npos)
        << (*screen)->state();
}

/// If any one call fails once, the picture is on the screen in the end, or a message says why not, and
/// nothing leaks. A projector that must be lit again is lit a second later by the machine's clock, which this
/// test does not cover.
TEST_P(SafeOnCard, RecoversFromOrReportsAnySingleFailedCall) {
    struct Outcome {
        std::vector<std::string> calls;
        std::string wrongs;
    };
    const auto once = [](std::size_t call, int error) {
        display::FakeKernel own;
        display::CardOnDesk card(own.add_card(display::card_path));
        card.card.atomic = GetParam();
        own.fail(call, error);
        std::string wrong;
        {
            const auto screen = programs::SafeScreen::open(display::card_path, safe_languages());
            bool shown = false;
            bool ended = !screen;
            for (int k = 0; k < 12 && !ended && !(shown && k > 1); ++k) {
                const Result<bool> now = (*screen)->show({"x", minutes(k)});
                shown = now.value_or(false);
                ended = !now;
            }
            const std::string state = ended ? "" : std::string((*screen)->state());
            if (!ended && !card.card.shown(card.hdmi) &&
                (state.empty() || state.find("is lit,") != std::string::npos)) {
                wrong = "dark, and it says: " + state;
            }
        }
        return Outcome{own.calls(), wrong + own.alive() + own.wrongs()};
    };
    const Outcome undisturbed = once(0, 0);
    ASSERT_EQ(undisturbed.wrongs, "");
    std::size_t runs = 0;
    for (std::size_t k = 1; k <= undisturbed.calls.size(); ++k) {
        const std::string& call = undisturbed.calls[k - 1];
        for (const int error : display::FakeKernel::errors_of(call)) {
            const Outcome disturbed = once(k, error);
            EXPECT_EQ(disturbed.wrongs, "") << "call " << k << ", " << call << ": " << error;
            ++runs;
        }
    }
    EXPECT_GT(runs, undisturbed.calls.size());
}

} // namespace
} // namespace frustumscreen::safe
