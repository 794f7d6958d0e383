#include "tests/display/presented_exhibit.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>

namespace frustumscreen::display {
namespace {

TEST(Presenter, WaitsOnceForAMissingFlipAndRelightsLater) {
    LitExhibit exhibit;
    exhibit.kms.hangs = true;
    exhibit.frame();
    const MonotonicTime hung = exhibit.kms.time;
    exhibit.frames(30);
    EXPECT_TRUE(exhibit.says("does not show the last picture")) << exhibit.presenter.state();
    EXPECT_LT(exhibit.kms.time - hung, flip_timeout + 31 * one_refresh + std::chrono::milliseconds(200));
    exhibit.frames(300);
    EXPECT_TRUE(exhibit.says("does not answer")) << exhibit.presenter.state();
    exhibit.kms.hangs = false;
    exhibit.frames(100);
    EXPECT_TRUE(exhibit.says("is lit")) << exhibit.presenter.state();
    const int flips = exhibit.kms.flips;
    exhibit.frames(10);
    EXPECT_EQ(exhibit.kms.flips, flips + 10);
}

TEST(Presenter, ContinuesAfterALateFlipWithoutSettingTheMode) {
    LitExhibit exhibit;
    exhibit.kms.hangs = true;
    exhibit.frames(10);
    exhibit.kms.hangs = false;
    exhibit.frames(10);
    EXPECT_TRUE(exhibit.says("is lit"));
    EXPECT_EQ(exhibit.kms.lights, 1) << "nothing was lost, so nothing is set again";
}

TEST(Presenter, SkipsAPictureWhileTheCardIsBusy) {
    LitExhibit exhibit;
    exhibit.kms.busy = 2;
    exhibit.frames(3);
    EXPECT_TRUE(exhibit.says("is lit"));
    EXPECT_EQ(exhibit.kms.flips, 4 + 1);
    EXPECT_EQ(exhibit.kms.lights, 1);
}

TEST(Presenter, WaitsForAnotherProgramToReleaseTheScreen) {
    LitExhibit exhibit;
    exhibit.kms.master = false;
    exhibit.kms.held_by_another = true;
    exhibit.frames(200);
    EXPECT_TRUE(exhibit.says("another program holds the screen")) << exhibit.presenter.state();
    EXPECT_FALSE(exhibit.presenter.lit());
    exhibit.kms.held_by_another = false;
    exhibit.frames(100);
    EXPECT_TRUE(exhibit.says("is lit"));
    EXPECT_EQ(exhibit.kms.lights, 2);
}

TEST(Presenter, ContinuesWithoutTheCardAndRequestsARestartWhenItIsBack) {
    LitExhibit exhibit;
    exhibit.kms.gone = true;
    exhibit.frames(100);
    EXPECT_TRUE(exhibit.says("graphics card is gone")) << exhibit.presenter.state();
    exhibit.presenter.connected({CardState::Gone, {}});
    exhibit.frames(100);
    EXPECT_TRUE(exhibit.says("graphics card is gone"));
    exhibit.presenter.connected({CardState::Back, {}});
    const Result<MonotonicTime> shown = exhibit.presenter.present({}, true);
    ASSERT_FALSE(shown);
    EXPECT_EQ(shown.error().kind, ErrorKind::DeviceLost);
}

TEST(Presenter, ResetsTheModeWhenTheKernelReportsABadLink) {
    LitExhibit exhibit;
    ConnectorSeen bad = a_projector();
    bad.link_bad = true;
    exhibit.presenter.connected(a_card({bad}));
    exhibit.frames(5);
    EXPECT_EQ(exhibit.kms.lights, 2);
    EXPECT_TRUE(exhibit.says("is lit"));
}

/// How long it tolerates the card before it requests a restart; nullopt: longer than a minute.
std::optional<Nanoseconds> patience(PresentedExhibit& exhibit) {
    const MonotonicTime begin = exhibit.kms.time;
    while (exhibit.kms.time - begin < std::chrono::minutes(1)) {
        exhibit.kms.time += std::chrono::milliseconds(16);
        if (!exhibit.presenter.present({0, 0, 1280, 800}, true)) {
            return exhibit.kms.time - begin;
        }
    }
    return std::nullopt;
}

TEST(Presenter, RequestsARestartWhenTheCardTakesNoPictureAnyMore) {
    for (const bool flips_stop : {false, true}) {
        for (const int width : {1280, 1920}) { // unscaled and scaled
            PresentedExhibit exhibit;
            ConnectorSeen projector = a_projector();
            projector.modes = {a_mode(width, 800, 60.0, true)};
            exhibit.presenter.connected(a_card({projector}));
            exhibit.frames(5);
            exhibit.kms.hangs = flips_stop; // all calls then answer that the previous flip is not done
            exhibit.kms.busy = flips_stop ? 0 : 1'000'000;
            const std::optional<Nanoseconds> patient = patience(exhibit);
            ASSERT_TRUE(patient);
            EXPECT_GE(*patient, stuck_given_up - one_refresh);
            EXPECT_LE(*patient, stuck_given_up + flip_given_up);
        }
    }
}

TEST(Presenter, ToleratesACardThatIsBrieflyBusyOrHasNoConnector) {
    PresentedExhibit busy;
    busy.presenter.connected(a_card({a_projector()}));
    busy.frames(5);
    for (int k = 0; k < 20; ++k) {
        busy.kms.busy = 100;
        busy.frames(110);
    }
    EXPECT_TRUE(busy.says("is lit"));
    PresentedExhibit dark;
    dark.presenter.connected(a_card({a_projector()}));
    dark.frames(5);
    dark.kms.hangs = true;
    dark.frames(60);
    dark.presenter.connected(a_card({}));
    EXPECT_EQ(patience(dark), std::nullopt);
}

TEST(Presenter, IsLitAfterRandomFaultsThatEnd) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        std::mt19937 random(seed);
        const auto one_of = [&random](int count) {
            return static_cast<int>(random() % static_cast<unsigned>(count));
        };
        PresentedExhibit exhibit;
        for (int step = 0; step < 60; ++step) {
            ConnectorSeen projector = a_projector();
            projector.plugged = one_of(3) == 0   ? Plugged::No
                                : one_of(5) == 0 ? Plugged::Unknown
                                                 : Plugged::Yes;
            projector.modes = {a_mode(640 + 160 * one_of(4), 480, 60.0, true)};
            switch (one_of(8)) {
            case 0:
            case 1:
                exhibit.presenter.connected(a_card({projector}));
                break;
            case 2:
                exhibit.kms.hangs = one_of(2) == 0;
                break;
            case 3:
                exhibit.kms.master = one_of(2) == 0;
                exhibit.kms.held_by_another = one_of(2) == 0;
                break;
            case 4:
                exhibit.kms.busy = one_of(4);
                break;
            case 5:
                exhibit.memory.none_left = one_of(2) == 0;
                break;
            default:
                break;
            }
            exhibit.frames(one_of(20));
        }
        exhibit.kms.hangs = false;
        exhibit.kms.held_by_another = false;
        exhibit.memory.none_left = false;
        exhibit.presenter.connected(a_card({a_projector()}));
        exhibit.frames(400);
        ASSERT_TRUE(exhibit.says("is lit")) << seed << ": " << exhibit.presenter.state();
        ASSERT_TRUE(exhibit.kms.screen);
        EXPECT_EQ(exhibit.kms.screen->mode.width, 1280) << seed;
        EXPECT_EQ(exhibit.memory.alive, 1) << seed;
    }
}

} // namespace
} // namespace frustumscreen::display
