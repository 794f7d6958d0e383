#include "tests/display/presented_exhibit.h"

#include <gtest/gtest.h>

#include <array>

namespace frustumscreen::display {
namespace {

TEST(Presenter, StaysDarkUntilAProjectorIsConnected) {
    PresentedExhibit exhibit;
    exhibit.frames(100);
    EXPECT_FALSE(exhibit.kms.screen);
    EXPECT_TRUE(exhibit.says("looked for"));
    ConnectorSeen off = a_projector();
    off.plugged = Plugged::No;
    off.modes.clear();
    exhibit.presenter.connected(a_card({off}));
    exhibit.frames(100);
    EXPECT_TRUE(exhibit.says("no projector is connected")) << exhibit.presenter.state();
    EXPECT_EQ(exhibit.memory.pairs, 0);
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frames(2);
    ASSERT_TRUE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.screen->mode, a_mode(1280, 800, 60.0, true));
    EXPECT_EQ(exhibit.presenter.state(), "the projector at HDMI-A-1 is lit, 1280 x 800 at 60 Hz");
}

TEST(Presenter, ShowsEveryPictureOnceInAlternatingFramebuffers) {
    PresentedExhibit exhibit;
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frame();
    FramebufferId before = 0;
    for (int k = 0; k < 100; ++k) {
        exhibit.frame();
        ASSERT_TRUE(exhibit.kms.screen);
        EXPECT_NE(exhibit.kms.screen->framebuffer, before);
        before = exhibit.kms.screen->framebuffer;
    }
    EXPECT_EQ(exhibit.kms.lights, 1);
    EXPECT_EQ(exhibit.kms.flips, 100);
    EXPECT_EQ(exhibit.memory.fills, 101);
    EXPECT_EQ(exhibit.kms.longest_wait, Nanoseconds(0))
        << "frames begin on flips: none waits for the one before";
}

TEST(Presenter, CopiesOnlyChangesSinceTheFramebufferWasLastShown) {
    PresentedExhibit exhibit;
    const PixelRectangle whole{0, 0, 1280, 800};
    exhibit.frame({5, 5, 1, 1}); // while dark
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frame({10, 10, 1, 1});
    EXPECT_EQ(exhibit.memory.filled, whole) << "new memory";
    exhibit.frame({20, 20, 1, 1});
    EXPECT_EQ(exhibit.memory.filled, whole) << "the other one is new too";
    exhibit.frame({30, 40, 5, 6});
    EXPECT_EQ(exhibit.memory.filled, (PixelRectangle{20, 20, 15, 26}))
        << "what changed for the one before and now";
    exhibit.frame({100, 100, 1, 1});
    EXPECT_EQ(exhibit.memory.filled, (PixelRectangle{30, 40, 71, 61}));
    exhibit.frame({});
    EXPECT_EQ(exhibit.memory.filled, (PixelRectangle{100, 100, 1, 1}));
    ConnectorSeen other = a_projector();
    other.modes = {a_mode(1920, 1080, 60.0, true)};
    exhibit.presenter.connected(a_card({other}));
    exhibit.frames(1);
    exhibit.frame({1, 1, 1, 1});
    EXPECT_EQ(exhibit.memory.filled, whole);
}

TEST(Presenter, ReadsTheFramebufferThatTheProjectorShows) {
    PresentedExhibit exhibit;
    std::array<std::byte, 4> pixel{};
    exhibit.frame();
    EXPECT_FALSE(exhibit.presenter.read_shown(pixel)) << "nothing is shown";
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frame();
    for (int k = 0; k < 100; ++k) {
        exhibit.kms.hangs = k % 7 == 3; // the previous flip is not done, so the shown picture stays
        exhibit.kms.busy = k % 5 == 2 ? 1 : 0;
        exhibit.frame();
        ASSERT_TRUE(exhibit.kms.screen);
        ASSERT_TRUE(exhibit.presenter.read_shown(pixel));
        EXPECT_EQ(static_cast<FramebufferId>(pixel[0]), exhibit.kms.screen->framebuffer) << k;
    }
    for (const bool card_scales : {true, false}) {
        ConnectorSeen larger = a_projector();
        larger.modes = {a_mode(card_scales ? 1920 : 1600, 1080, 60.0, true)};
        exhibit.kms.hangs = false;
        exhibit.kms.scales = card_scales;
        exhibit.presenter.connected(a_card({larger}));
        exhibit.frames(10);
        ASSERT_TRUE(exhibit.kms.screen);
        ASSERT_TRUE(exhibit.presenter.read_shown(pixel)) << "of a scaled picture too";
        EXPECT_EQ(static_cast<FramebufferId>(pixel[0]), exhibit.kms.screen->framebuffer);
    }
}

TEST(Presenter, ReturnsTheTimeOfTheRefreshThatShowsThePicture) {
    PresentedExhibit exhibit;
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frames(3);
    for (int k = 0; k < 200; ++k) {
        const MonotonicTime told = exhibit.frame();
        exhibit.frame();
        EXPECT_LT(std::chrono::abs(told - exhibit.kms.flipped), std::chrono::microseconds(200));
    }
}

TEST(Presenter, RechecksWhetherFlipsKeepTimeAfterEachModeSet) {
    // Frames begin on refreshes only if the query came at a time when the kernel could answer.
    PresentedExhibit exhibit;
    for (const double hz : {60.0, 59.94}) {
        ConnectorSeen projector = a_projector();
        projector.modes = {a_mode(1280, 800, hz, true)};
        exhibit.presenter.connected(a_card({projector}));
        exhibit.frames(5);
        exhibit.kms.time += std::chrono::milliseconds(7);
        exhibit.frames(2);
        const Nanoseconds off = exhibit.kms.time.time_since_epoch() % one_refresh;
        EXPECT_LT(std::min(off, one_refresh - off), std::chrono::microseconds(200)) << hz;
    }
    EXPECT_EQ(exhibit.kms.lights, 2);
}

TEST(Presenter, PacesItselfIfFlipsKeepNoTime) {
    PresentedExhibit exhibit;
    exhibit.kms.keeps_time = false;
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frame();
    const MonotonicTime begin = exhibit.kms.time;
    exhibit.frames(60);
    EXPECT_EQ(exhibit.kms.time - begin, 60 * one_refresh);
    const MonotonicTime told = exhibit.frame();
    EXPECT_EQ(told, exhibit.kms.time - one_refresh + std::chrono::milliseconds(5));
}

TEST(Presenter, GoesDarkOnUnplugAndResetsTheModeOnReplug) {
    PresentedExhibit exhibit;
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frames(10);
    ConnectorSeen off = a_projector();
    off.plugged = Plugged::No;
    exhibit.presenter.connected(a_card({off}));
    exhibit.frames(10);
    EXPECT_FALSE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.darkenings, 1);
    EXPECT_TRUE(exhibit.says("no projector")) << exhibit.presenter.state();
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frames(2);
    EXPECT_TRUE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.lights, 2);
    EXPECT_EQ(exhibit.memory.pairs, 1) << "the same mode needs no new memory";
}

TEST(Presenter, SurvivesUnplugAndReplugAtEveryStep) {
    // The projector is unplugged before step k and comes back m steps later.
    for (int gone_at = 0; gone_at < 12; ++gone_at) {
        for (int back_after = 0; back_after < 6; ++back_after) {
            PresentedExhibit exhibit;
            exhibit.kms.busy = gone_at % 3;
            ConnectorSeen off = a_projector();
            off.plugged = Plugged::No;
            exhibit.presenter.connected(a_card({a_projector()}));
            exhibit.frames(gone_at);
            exhibit.presenter.connected(a_card({off}));
            exhibit.frames(back_after);
            exhibit.presenter.connected(a_card({a_projector()}));
            exhibit.frames(20);
            ASSERT_TRUE(exhibit.kms.screen) << gone_at << ", " << back_after;
            ASSERT_TRUE(exhibit.says("is lit")) << exhibit.presenter.state();
            const int flips = exhibit.kms.flips;
            exhibit.frames(10);
            EXPECT_EQ(exhibit.kms.flips, flips + 10);
        }
    }
}

TEST(Presenter, SwitchesToAnotherModeAndFreesTheOldMemory) {
    LitExhibit exhibit;
    ConnectorSeen other = a_projector();
    other.modes = {a_mode(1920, 1080, 60.0, true)};
    exhibit.presenter.connected(a_card({other}));
    exhibit.frames(5);
    ASSERT_TRUE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.screen->mode.width, 1920);
    EXPECT_EQ(exhibit.memory.pairs, 2);
    EXPECT_EQ(exhibit.memory.alive, 1) << "what was shown before is given back";
}

TEST(Presenter, KeepsTheLitProjectorWhenAnotherIsPlugged) {
    PresentedExhibit exhibit;
    exhibit.presenter.connected(a_card({a_projector(2, "HDMI-A-2")}));
    exhibit.frames(5);
    exhibit.presenter.connected(a_card({a_projector(1, "DP-1"), a_projector(2, "HDMI-A-2")}));
    exhibit.frames(5);
    EXPECT_EQ(exhibit.kms.lights, 1);
    EXPECT_EQ(exhibit.kms.screen->connector, 2U);
}

TEST(Presenter, TriesTheNextModeWhenTheCardRefusesOne) {
    PresentedExhibit exhibit;
    ConnectorSeen projector = a_projector();
    projector.modes = {a_mode(3840, 2160, 60.0, true), a_mode(1920, 1200, 60.0), a_mode(1280, 800, 60.0)};
    exhibit.kms.refused = {projector.modes[0], projector.modes[2]};
    exhibit.presenter.connected(a_card({projector}));
    exhibit.frames(3);
    ASSERT_TRUE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.screen->mode.width, 1920);
    EXPECT_EQ(exhibit.memory.alive, 1);
    exhibit.kms.refused = projector.modes;
    PresentedExhibit none;
    none.kms.refused = projector.modes;
    none.presenter.connected(a_card({projector}));
    none.frames(200);
    EXPECT_TRUE(none.says("refuses every mode of the projector at HDMI-A-1")) << none.presenter.state();
    EXPECT_LE(none.kms.lights, 3 * 5) << "tried again every second, not every frame";
}

TEST(Presenter, SetsNoModeWhileTheCardIsProbed) {
    PresentedExhibit exhibit;
    exhibit.presenter.connected(a_card({a_projector()}));
    ASSERT_TRUE(exhibit.presenter.present({}, false));
    EXPECT_EQ(exhibit.kms.lights, 0);
    ASSERT_TRUE(exhibit.presenter.present({}, true));
    EXPECT_EQ(exhibit.kms.lights, 1);
}

TEST(Presenter, IsSettledWhenTheFirstPictureIsShownOrNothingCanShowIt) {
    PresentedExhibit exhibit;
    exhibit.frame();
    EXPECT_FALSE(exhibit.presenter.settled()) << "what is connected is not known yet";
    exhibit.presenter.connected(a_card({a_projector()}));
    EXPECT_FALSE(exhibit.presenter.settled());
    exhibit.frame();
    EXPECT_EQ(exhibit.presenter.settled(), exhibit.says("is lit")) << "its flip is on the way";
    exhibit.frame();
    EXPECT_TRUE(exhibit.presenter.settled());
    PresentedExhibit dark;
    dark.presenter.connected(a_card({}));
    EXPECT_TRUE(dark.presenter.settled());
    PresentedExhibit refused;
    refused.kms.refused = a_projector().modes;
    refused.presenter.connected(a_card({a_projector()}));
    refused.frame();
    EXPECT_TRUE(refused.presenter.settled());
}

TEST(Presenter, APictureWithoutASizeIsDrawnInThePreferredModesSize) {
    PresentedExhibit exhibit{OutputRequest{}};
    exhibit.kms.scales = true; // it would scale a picture that has a size
    ConnectorSeen projector = a_projector();
    projector.modes = {a_mode(640, 480, 60.0), a_mode(1920, 1080, 60.0, true)};
    exhibit.presenter.connected(a_card({projector}));
    exhibit.frames(2);
    ASSERT_TRUE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.screen->size, (PixelSize{1920, 1080}));
    EXPECT_EQ(exhibit.kms.screen->place, (PixelRectangle{0, 0, 1920, 1080}));
    projector.modes.pop_back();
    exhibit.presenter.connected(a_card({projector}));
    exhibit.frames(3);
    EXPECT_EQ(exhibit.kms.screen->size, (PixelSize{640, 480}));
}

TEST(Presenter, WaitsUntilThePictureIsShownOrTheFlipFails) {
    PresentedExhibit exhibit;
    EXPECT_FALSE(exhibit.presenter.wait_until_shown()) << "there is no projector";
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frame();
    EXPECT_TRUE(exhibit.presenter.wait_until_shown());
    const FramebufferId before = exhibit.kms.screen->framebuffer;
    exhibit.frame();
    EXPECT_TRUE(exhibit.presenter.wait_until_shown());
    EXPECT_NE(exhibit.kms.screen->framebuffer, before);
    exhibit.kms.hangs = true;
    exhibit.frame();
    EXPECT_FALSE(exhibit.presenter.wait_until_shown());
}

} // namespace
} // namespace frustumscreen::display
