// A whole window on SDL's offscreen driver, and what a person does to it as SDL's own events.
#include "firmware_host/window/sdl_window.h"

#include <GLES3/gl31.h>
#include <SDL.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <vector>

namespace frustumscreen::window {
namespace {

constexpr int width = 320;
constexpr int height = 200;

class SdlWindowTest : public testing::Test {
protected:
    void SetUp() override {
        ::setenv("SDL_VIDEODRIVER", "offscreen", 1);
        WindowSetUp set_up;
        set_up.width = width;
        set_up.height = height;
        set_up.table_from_picture = [](const glm::dvec2& pixel) { // a millimetre a pixel, top = far
            return std::optional(glm::dvec2(pixel.x - width / 2, height / 2 - pixel.y) * 1e-3);
        };
        set_up.table_from_view = [](const glm::dvec2& pixel, const glm::dvec3&,
                                    PixelSize half) { // a centimetre a pixel
            EXPECT_EQ(half, (PixelSize{width, height}));
            return std::optional(glm::dvec2(pixel.x - width / 2, height / 2 - pixel.y) * 1e-2);
        };
        set_up.half_extent_m = {1.0, 1.0};
        set_up.see = [this](const tracker::PoseSample& prop, const glm::dvec3& eye_m, PixelSize,
                            SeenSurfaces& seen) {
            seen_prop_m_ = prop.position_m;
            seen_eye_m_ = eye_m;
            // The upper half of the view: the picture at half its light, and a green light of its own.
            for (const glm::vec2 corner : {glm::vec2(-1, 0), glm::vec2(1, 0), glm::vec2(1, 1),
                                           glm::vec2(-1, 0), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
                seen.triangles.push_back(
                    {glm::vec4(corner, 0, 1), {0.5F, 0.5F, 1.0F}, 0.5F, {0.0F, 0.2F, 0.0F}});
            }
        };
        set_up.help = {{2, 2}, {1, 2, 3, 255, 4, 5, 6, 255, 7, 8, 9, 255, 10, 11, 12, 255}};
        Result<Window> opened = open_window(set_up);
        ASSERT_TRUE(opened) << opened.error().message;
        window_ = std::move(*opened);
    }

    static void button(Uint32 type, Uint8 which, int x, int y) {
        SDL_Event event{};
        event.type = type;
        event.button.button = which;
        event.button.x = x;
        event.button.y = y;
        SDL_PushEvent(&event);
    }
    static void motion(int x, int y, int dx = 0, Uint32 held = 0) {
        SDL_Event event{};
        event.type = SDL_MOUSEMOTION;
        event.motion.x = x;
        event.motion.y = y;
        event.motion.xrel = dx;
        event.motion.state = held;
        SDL_PushEvent(&event);
    }
    static void key(SDL_Keycode code) {
        SDL_Event event{};
        event.type = SDL_KEYDOWN;
        event.key.keysym.sym = code;
        SDL_PushEvent(&event);
    }
    tracker::PoseSample prop(std::int64_t us) {
        std::vector<tracker::PoseSample> samples;
        EXPECT_TRUE(window_.tracker->poll(from_microseconds(us), samples));
        EXPECT_EQ(samples.size(), 2U);
        EXPECT_EQ(samples[1].station, tracker::head_station);
        head_m_ = samples[1].position_m;
        EXPECT_EQ(samples[0].time, from_microseconds(us));
        return samples[0];
    }

    /// A code of the window itself; rows from the top.
    [[nodiscard]] std::array<unsigned char, 4> shown(int x, int y) const {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        std::array<unsigned char, 4> texel{};
        glReadPixels(x, height - 1 - y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, texel.data());
        return texel;
    }
    void present(float red, float green, float blue) {
        glBindFramebuffer(GL_FRAMEBUFFER, window_.display->framebuffer());
        glClearColor(red, green, blue, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        ASSERT_TRUE(window_.display->present(from_microseconds(1)));
    }

    Window window_;
    glm::dvec3 head_m_{0.0};
    glm::dvec3 seen_prop_m_{0.0};
    glm::dvec3 seen_eye_m_{0.0};
};

TEST_F(SdlWindowTest, IsADisplayThatKeepsItsPicture) {
    EXPECT_EQ(window_.display->width(), width);
    glBindFramebuffer(GL_FRAMEBUFFER, window_.display->framebuffer());
    glClearColor(0.0F, 1.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    for (int k = 0; k < 3; ++k) {
        const Result<MonotonicTime> shown = window_.display->present(from_microseconds(9));
        ASSERT_TRUE(shown);
        EXPECT_EQ(*shown, from_microseconds(9));
    }
    EXPECT_EQ(window_.display->buffer_age(), 1);
    glBindFramebuffer(GL_FRAMEBUFFER, window_.display->framebuffer());
    std::array<unsigned char, 4> texel{};
    glReadPixels(width - 1, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, texel.data());
    EXPECT_EQ(texel, (std::array<unsigned char, 4>{0, 255, 0, 255}));
}

TEST_F(SdlWindowTest, TheMouseSlidesAndTurnsTheProp) {
    EXPECT_EQ(prop(1).position_m, glm::dvec3(0.0));
    button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_LEFT, 160, 100);
    motion(190, 80);
    EXPECT_NEAR(glm::distance(prop(2).position_m, {0.030, 0.020, 0.0}), 0.0, 1e-9);
    button(SDL_MOUSEBUTTONUP, SDL_BUTTON_LEFT, 190, 80);
    motion(10, 10);
    EXPECT_NEAR(glm::distance(prop(3).position_m, {0.030, 0.020, 0.0}), 0.0, 1e-9);
    motion(10, 10, 90, SDL_BUTTON_RMASK);
    EXPECT_NEAR(glm::degrees(glm::angle(prop(4).rotation)), 45.0, 1.0);
}

TEST_F(SdlWindowTest, MiddleDragMovesTheEyeAroundTheTable) {
    static_cast<void>(prop(1));
    const glm::dvec3 before = head_m_;
    EXPECT_NEAR(glm::distance(before, {0.0, -0.55, 0.5}), 0.0, 1e-9);
    motion(10, 10, 90, SDL_BUTTON_MMASK);
    EXPECT_EQ(prop(2).position_m, glm::dvec3(0.0));
    EXPECT_NEAR(glm::length(head_m_), glm::length(before), 1e-9);
    EXPECT_NEAR(head_m_.z, before.z, 1e-9);
    EXPECT_NEAR(head_m_.x, -0.55 * std::sin(0.0087 * 90), 1e-9);
}

TEST_F(SdlWindowTest, ShowsThePictureAndTheVisitorsView) {
    present(1.0F, 0.0F, 0.0F);
    EXPECT_EQ(shown(width / 2, height / 2), (std::array<unsigned char, 4>{255, 0, 0, 255}));
    // Half of the red light, 0.2 of green: codes 188 and 124.
    EXPECT_EQ(shown(width + width / 2, height / 4), (std::array<unsigned char, 4>{188, 124, 0, 255}));
    EXPECT_EQ(shown(width + width / 2, 3 * height / 4), (std::array<unsigned char, 4>{0, 0, 0, 255}));
}

TEST_F(SdlWindowTest, DragInTheVisitorsHalfFollowsTheTablePoint) {
    present(0.0F, 0.0F, 0.0F);
    button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_LEFT, width + 160, 100);
    motion(width + 170, 95, 10, SDL_BUTTON_LMASK);
    EXPECT_NEAR(glm::distance(prop(2).position_m, {0.10, 0.05, 0.0}), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(seen_prop_m_, {0.10, 0.05, 0.0}), 0.0, 1e-9); // shown at once
}

TEST_F(SdlWindowTest, HelpKeyTogglesTheHelpOverlay) {
    present(0.0F, 0.0F, 1.0F);
    for (int time = 0; time < 2; ++time) {
        EXPECT_EQ(shown(width - 1, height / 2 - 1), (std::array<unsigned char, 4>{0, 0, 255, 255}));
        key(SDLK_h);
        static_cast<void>(prop(2 * time));
        EXPECT_EQ(shown(width - 1, height / 2 - 1), (std::array<unsigned char, 4>{1, 2, 3, 255}));
        EXPECT_EQ(shown(width, height / 2), (std::array<unsigned char, 4>{10, 11, 12, 255}));
        key(SDLK_h);
        static_cast<void>(prop(2 * time + 1));
    }
}

TEST_F(SdlWindowTest, DigitKeysPressButtonsAndEscapeEnds) {
    key(SDLK_2);
    key(SDLK_1);
    key(SDLK_5);
    key(SDLK_0);
    key(SDLK_8);
    static_cast<void>(prop(5));
    std::vector<panel::PanelEvent> events;
    ASSERT_TRUE(window_.panel->poll(from_microseconds(5), events));
    ASSERT_EQ(events.size(), 3U);
    EXPECT_EQ(events[0].button, 1);
    EXPECT_EQ(events[1].button, 0);
    EXPECT_EQ(events[2].button, 4);
    EXPECT_EQ(events[1].time, from_microseconds(5));
    sigset_t term{};
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &term, nullptr);
    key(SDLK_ESCAPE);
    static_cast<void>(prop(6));
    const timespec at_once{};
    EXPECT_EQ(sigtimedwait(&term, nullptr, &at_once), SIGTERM);
}

TEST(NoDesktop, IsReportedAsAnError) {
    for (const char* display : {"DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"}) {
        ::unsetenv(display);
    }
    const Result<Window> opened = open_window({});
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().message.rfind("window: there is no desktop here: ", 0), 0U)
        << opened.error().message;
}

} // namespace
} // namespace frustumscreen::window
