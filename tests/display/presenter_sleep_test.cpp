// A projector that is intentionally dark.

#include "tests/display/presented_exhibit.h"

#include <gtest/gtest.h>

namespace frustumscreen::display {
namespace {

ConnectorSeen unplugged() {
    ConnectorSeen off = a_projector();
    off.plugged = Plugged::No;
    off.modes.clear();
    return off;
}

/// An exhibit with a lit projector; sleep also runs in frames of 60 Hz.
class SleepingExhibit : public PresentedExhibit {
public:
    SleepingExhibit() {
        presenter.connected(a_card({a_projector()}));
        frames(10);
    }
    void sleep(int count, bool may_set = true) {
        for (int k = 0; k < count; ++k) {
            const MonotonicTime called = kms.time;
            EXPECT_TRUE(presenter.stay_dark(may_set));
            EXPECT_LE(kms.time - called, flip_timeout) << "sleep held up the exhibit";
            kms.time += one_refresh;
        }
    }
};

TEST(PresenterSleep, TurnsOffOnceAndRelightsWithTheNextPicture) {
    SleepingExhibit exhibit;
    exhibit.sleep(600);
    EXPECT_FALSE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.darkenings, 1);
    EXPECT_EQ(exhibit.kms.lights, 1);
    EXPECT_TRUE(exhibit.says("dark on purpose")) << exhibit.presenter.state();
    const MonotonicTime pressed = exhibit.kms.time;
    exhibit.frames(2);
    ASSERT_TRUE(exhibit.kms.screen);
    EXPECT_LE(exhibit.kms.time - pressed, std::chrono::milliseconds(100));
    EXPECT_EQ(exhibit.kms.lights, 2);
    EXPECT_EQ(exhibit.presenter.state(), "the projector at HDMI-A-1 is lit, 1280 x 800 at 60 Hz");
}

TEST(PresenterSleep, RetriesWhenTheCardRefusesToDarken) {
    SleepingExhibit exhibit;
    exhibit.kms.refused = {{}}; // an empty mode means that the screen is off
    exhibit.sleep(59);
    EXPECT_TRUE(exhibit.kms.screen);
    EXPECT_TRUE(exhibit.says("is lit")) << exhibit.presenter.state();
    exhibit.kms.refused.clear();
    exhibit.sleep(60);
    EXPECT_FALSE(exhibit.kms.screen);
    EXPECT_TRUE(exhibit.says("dark on purpose")) << exhibit.presenter.state();
}

TEST(PresenterSleep, StaysDarkDuringHotplug) {
    SleepingExhibit exhibit;
    exhibit.sleep(10);
    for (int k = 0; k < 5; ++k) {
        exhibit.presenter.connected(a_card({unplugged()}));
        exhibit.sleep(120);
        exhibit.presenter.connected(a_card({a_projector()}));
        exhibit.sleep(120);
    }
    EXPECT_FALSE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.lights, 1);
    EXPECT_TRUE(exhibit.says("dark on purpose")) << exhibit.presenter.state();
    exhibit.frames(2);
    EXPECT_TRUE(exhibit.kms.screen);
}

TEST(PresenterSleep, WakesWithoutAProjectorAndLightsItOnceConnected) {
    SleepingExhibit exhibit;
    exhibit.sleep(10);
    exhibit.presenter.connected(a_card({unplugged()}));
    exhibit.sleep(10);
    exhibit.frames(60);
    EXPECT_FALSE(exhibit.kms.screen);
    EXPECT_TRUE(exhibit.says("no projector is connected")) << exhibit.presenter.state();
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frames(2);
    EXPECT_TRUE(exhibit.kms.screen);
}

TEST(PresenterSleep, FallsAsleepWithoutAProjector) {
    PresentedExhibit exhibit;
    exhibit.presenter.connected(a_card({unplugged()}));
    exhibit.frames(10);
    EXPECT_TRUE(exhibit.presenter.stay_dark(true));
    EXPECT_TRUE(exhibit.says("dark on purpose")) << exhibit.presenter.state();
    exhibit.frames(10);
    EXPECT_EQ(exhibit.kms.lights, 0);
}

TEST(PresenterSleep, WaitsForTheCardToBeFreeAndRetries) {
    SleepingExhibit exhibit;
    exhibit.sleep(10, false);
    EXPECT_EQ(exhibit.kms.darkenings, 0) << "another program asks the card";
    exhibit.kms.busy = 3;
    exhibit.sleep(60);
    EXPECT_EQ(exhibit.kms.darkenings, 1);
    EXPECT_FALSE(exhibit.kms.screen);
}

TEST(PresenterSleep, WakingBeforeItIsDarkChangesNothing) {
    SleepingExhibit exhibit;
    exhibit.sleep(1, false);
    exhibit.frames(10);
    EXPECT_TRUE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.lights, 1);
    EXPECT_TRUE(exhibit.says("is lit")) << exhibit.presenter.state();
}

TEST(PresenterSleep, RequestsARestartWhenARemovedCardIsBack) {
    SleepingExhibit exhibit;
    exhibit.sleep(10);
    CardSeen back = a_card({a_projector()});
    back.state = CardState::Back;
    exhibit.presenter.connected(back);
    EXPECT_FALSE(exhibit.presenter.stay_dark(true));
}

} // namespace
} // namespace frustumscreen::display
