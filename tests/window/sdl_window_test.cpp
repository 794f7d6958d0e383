// A whole window on SDL's offscreen driver, and what a person does to it as SDL's own events.
#include "firmware_host/window/sdl_window.h"

#include <GLES3/gl31.h>
#include <SDL.h>
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <vector>

namespace frustumscreen {
namespace {

constexpr int width = 320;
constexpr int height = 200;

class AWindow : public testing::Test {
protected:
    void SetUp() override {
        ::setenv("SDL_VIDEODRIVER", "offscreen", 1);
        WindowSetUp set_up;
        set_up.width = width;
        set_up.height = height;
        set_up.table_from_picture = [](const glm::dvec2& pixel) { // a millimetre a pixel, top = far
            return std::optional(glm::dvec2(pixel.x - width / 2, height / 2 - pixel.y) * 1e-3);
        };
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
    PoseSample prop(std::int64_t us) {
        std::vector<PoseSample> samples;
        EXPECT_TRUE(window_.tracker->poll(from_microseconds(us), samples));
        EXPECT_EQ(samples.size(), 1U);
        EXPECT_EQ(samples[0].time, from_microseconds(us));
        return samples[0];
    }

    Window window_;
};

TEST_F(AWindow, IsADisplayThatKeepsItsPicture) {
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

TEST_F(AWindow, TheMouseSlidesAndTurnsTheProp) {
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

TEST_F(AWindow, KeysAreButtonsAndEscapeEnds) {
    key(SDLK_2);
    key(SDLK_1);
    key(SDLK_9);
    static_cast<void>(prop(5));
    std::vector<PanelEvent> events;
    ASSERT_TRUE(window_.panel->poll(from_microseconds(5), events));
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].button, 1);
    EXPECT_EQ(events[1].button, 0);
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

TEST(NoDesktop, IsSaidAndNotTakenForOne) {
    for (const char* display : {"DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"}) {
        ::unsetenv(display);
    }
    const Result<Window> opened = open_window({width, height, {}, {}});
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().message.rfind("window: there is no desktop here: ", 0), 0U)
        << opened.error().message;
}

} // namespace
} // namespace frustumscreen
