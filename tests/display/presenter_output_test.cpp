// Which output the presenter lights, how, and what it reports.
#include "tests/display/presented_exhibit.h"

namespace frustumscreen::display {
namespace {

TEST(PresenterOutput, LeavesScalingToACardThatSupportsIt) {
    PresentedExhibit exhibit;
    exhibit.kms.scales = true;
    ConnectorSeen projector = a_projector();
    projector.modes = {a_mode(1920, 1080, 60.0, true)};
    exhibit.presenter.connected(a_card({projector}));
    exhibit.frame({10, 20, 30, 40});
    EXPECT_EQ(exhibit.memory.filled, (PixelRectangle{0, 0, 1280, 800}));
    exhibit.frames(5);
    ASSERT_TRUE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.screen->mode.width, 1920);
    EXPECT_EQ(exhibit.kms.screen->size, (PixelSize{1280, 800})) << "memory of the picture's size";
    EXPECT_EQ(exhibit.kms.screen->place, (PixelRectangle{96, 0, 1728, 1080})) << "black at the sides";
    EXPECT_EQ(exhibit.memory.pairs, 1);
    projector.modes = {a_mode(1024, 768, 60.0, true)};
    exhibit.presenter.connected(a_card({projector}));
    exhibit.frames(5);
    EXPECT_EQ(exhibit.kms.screen->place, (PixelRectangle{0, 64, 1024, 640}));
    EXPECT_EQ(exhibit.memory.pairs, 1) << "another mode needs no new memory";
}

TEST(PresenterOutput, ScalesItselfAfterTheCardRefusesOnce) {
    PresentedExhibit exhibit;
    ConnectorSeen projector = a_projector();
    for (const int width : {1920, 1600, 1920}) {
        projector.modes = {a_mode(width, 1080, 60.0, true)};
        exhibit.presenter.connected(a_card({projector}));
        exhibit.frames(5);
        ASSERT_TRUE(exhibit.kms.screen);
        EXPECT_EQ(exhibit.kms.screen->size, (PixelSize{width, 1080}));
        EXPECT_EQ(exhibit.kms.screen->place, (PixelRectangle{0, 0, width, 1080}));
        EXPECT_EQ(exhibit.memory.alive, 1);
    }
    EXPECT_EQ(exhibit.kms.scalings_refused, 1);
}

TEST(PresenterOutput, ScalesItselfIfTheCardRefusesScaledFlips) {
    PresentedExhibit exhibit;
    exhibit.kms.scales = true;
    ConnectorSeen projector = a_projector();
    projector.modes = {a_mode(1920, 1080, 60.0, true)};
    exhibit.kms.no_scaled_flips = true;
    exhibit.presenter.connected(a_card({projector}));
    exhibit.frames(60);
    ASSERT_TRUE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.screen->mode.width, 1920) << "the mode itself is fit";
    EXPECT_EQ(exhibit.kms.screen->size, (PixelSize{1920, 1080}));
    EXPECT_TRUE(exhibit.says("is lit")) << exhibit.presenter.state();
}

OutputRequest forced_on_hdmi() {
    OutputRequest request = wish_for_the_preferred();
    request.connector = "HDMI-A-1";
    request.width = 1280;
    request.height = 800;
    request.refresh_hz = 60.0;
    request.force = true;
    return request;
}

ConnectorSeen unseen_projector() {
    ConnectorSeen projector = a_projector();
    projector.plugged = Plugged::No;
    projector.modes.clear();
    return projector;
}

TEST(PresenterOutput, LightsAForcedConnectorThatReportsNothingConnected) {
    PresentedExhibit exhibit(forced_on_hdmi());
    exhibit.presenter.connected(a_card({unseen_projector()}));
    exhibit.frames(5);
    ASSERT_TRUE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.screen->mode, make_mode(1280, 800, 60.0));
    EXPECT_TRUE(exhibit.says("though it says that nothing is connected")) << exhibit.presenter.state();
    EXPECT_TRUE(exhibit.says("video=HDMI-A-1:1280x800@60e")) << exhibit.presenter.state();
    exhibit.presenter.connected(a_card({unseen_projector()}));
    exhibit.frames(100);
    EXPECT_EQ(exhibit.kms.lights, 1) << "it stays lit";
    exhibit.presenter.connected(a_card({a_projector()})); // the projector answers after all
    exhibit.frames(5);
    EXPECT_EQ(exhibit.kms.screen->mode, a_projector().modes.front());
    EXPECT_EQ(exhibit.presenter.state(), "the projector at HDMI-A-1 is lit, 1280 x 800 at 60 Hz");
    exhibit.presenter.connected(a_card({unseen_projector()}));
    exhibit.frames(5);
    EXPECT_TRUE(exhibit.kms.screen) << "off, or silent: it is lit all the same";
    EXPECT_TRUE(exhibit.says("though it says"));
}

TEST(PresenterOutput, NamesTheKernelArgumentThatForcesAConnector) {
    PresentedExhibit exhibit(forced_on_hdmi());
    exhibit.kms.refused = {make_mode(1280, 800, 60.0)};
    exhibit.presenter.connected(a_card({unseen_projector()}));
    exhibit.frames(5);
    EXPECT_FALSE(exhibit.kms.screen);
    EXPECT_TRUE(exhibit.says("does not light HDMI-A-1")) << exhibit.presenter.state();
    EXPECT_TRUE(exhibit.says("start the kernel with video=HDMI-A-1:1280x800@60e"))
        << exhibit.presenter.state();
}

TEST(PresenterOutput, ReportsWhyFramebuffersCannotBeMade) {
    PresentedExhibit exhibit;
    exhibit.memory.none_left = true;
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frames(5);
    EXPECT_EQ(exhibit.presenter.state(),
              "the graphics card refuses every mode of the projector at HDMI-A-1: no "
              "memory; the exhibit goes on in the dark");
    exhibit.memory.none_left = false;
    exhibit.kms.refused = a_projector().modes;
    exhibit.frames(100);
    EXPECT_FALSE(exhibit.says("no memory")) << "that is over: " << exhibit.presenter.state();
    EXPECT_TRUE(exhibit.says("refuses every mode"));
}

TEST(PresenterOutput, ReportsTheShortcomingOfTheConnector) {
    PresentedExhibit exhibit;
    exhibit.kms.lacks = "its range is unknown";
    exhibit.presenter.connected(a_card({a_projector()}));
    exhibit.frames(5);
    EXPECT_EQ(exhibit.presenter.state(),
              "the projector at HDMI-A-1 is lit, 1280 x 800 at 60 Hz; its range is unknown");
}

TEST(PresenterOutput, RequestsARestartIfAnotherCardHasTheProjector) {
    PresentedExhibit exhibit;
    exhibit.presenter.connected(a_card({unseen_projector()}));
    exhibit.frames(5);
    CardSeen seen = a_card({unseen_projector()});
    seen.state = CardState::Elsewhere;
    exhibit.presenter.connected(seen);
    const Result<MonotonicTime> shown = exhibit.presenter.present({}, true);
    ASSERT_FALSE(shown);
    EXPECT_EQ(shown.error().kind, ErrorKind::DeviceLost);
    EXPECT_EQ(shown.error().id, "display.projector_elsewhere") << shown.error().message;
    EXPECT_TRUE(exhibit.says("another graphics card")) << exhibit.presenter.state();
}

TEST(PresenterOutput, LeavesAModeInWhichNoFlipSucceeds) {
    PresentedExhibit exhibit;
    ConnectorSeen projector = a_projector();
    projector.modes = {a_mode(1920, 1080, 60.0, true), a_mode(1280, 720, 60.0)};
    exhibit.kms.no_flips = {projector.modes[0]};
    exhibit.presenter.connected(a_card({projector}));
    exhibit.frames(30);
    ASSERT_TRUE(exhibit.kms.screen);
    EXPECT_EQ(exhibit.kms.screen->mode.width, 1280);
    EXPECT_TRUE(exhibit.says("is lit"));
    EXPECT_EQ(exhibit.kms.lights, 2);
}

TEST(PresenterOutput, NamesTheRemedyForConnectorAndModeFaults) {
    OutputRequest request = wish_for_the_preferred();
    request.connector = "DP-3";
    PresentedExhibit exhibit(request);
    exhibit.presenter.connected(a_card({a_projector(), a_projector(2, "VGA-1")}));
    EXPECT_TRUE(exhibit.says("no connector DP-3; it has HDMI-A-1, VGA-1")) << exhibit.presenter.state();
    ConnectorSeen mute = a_projector(3, "DP-3");
    mute.modes.clear();
    exhibit.presenter.connected(a_card({mute}));
    EXPECT_TRUE(exhibit.says("names no mode; set display.mode and display.force"))
        << exhibit.presenter.state();
    request = wish_for_the_preferred();
    request.width = 1024;
    request.height = 768;
    PresentedExhibit other(request);
    other.presenter.connected(a_card({a_projector()}));
    other.frames(2);
    EXPECT_TRUE(other.says("because it cannot do the mode in the settings")) << other.presenter.state();
}

OutputRequest both_eyes(EyeLayout eyes) {
    OutputRequest request = wish_for_the_preferred();
    request.eyes = eyes;
    return request;
}

TEST(PresenterOutput, UsesAFramebufferOfTwiceTheHeightForAlternatingEyes) {
    for (const bool scales : {true, false}) {
        PresentedExhibit exhibit(both_eyes(EyeLayout::InTurn));
        exhibit.kms.scales = scales;
        exhibit.kms.turns = true;
        ConnectorSeen projector = a_projector();
        projector.modes = {a_mode(1920, 1080, 120.0, true)};
        exhibit.presenter.connected(a_card({projector}));
        exhibit.frame({10, 20, 30, 40});
        EXPECT_EQ(exhibit.memory.filled, (PixelRectangle{0, 0, 1280, 1600}));
        EXPECT_EQ(exhibit.memory.size, scales ? (PixelSize{1280, 1600}) : (PixelSize{1920, 2160}));
        exhibit.frames(5);
        ASSERT_TRUE(exhibit.kms.screen);
        EXPECT_EQ(exhibit.kms.screen->size, scales ? (PixelSize{1280, 800}) : (PixelSize{1920, 1080}));
        EXPECT_EQ(exhibit.kms.screen->place,
                  scales ? (PixelRectangle{96, 0, 1728, 1080}) : (PixelRectangle{0, 0, 1920, 1080}));
        EXPECT_EQ(exhibit.presenter.state(),
                  "the projector at HDMI-A-1 is lit, 1920 x 1080 at 120 Hz; each eye gets 60 Hz");
        exhibit.kms.turns = false;
        exhibit.frames(2);
        EXPECT_EQ(exhibit.presenter.condition().id, "display.one_eye") << "told as soon as it is known";
    }
}

TEST(PresenterOutput, ReportsTheEyeLayoutWithEveryOtherState) {
    OutputRequest request = both_eyes(EyeLayout::SideBySide);
    request.width = 1024;
    request.height = 768;
    PresentedExhibit other(request);
    other.kms.lacks = "its range is unknown";
    other.presenter.connected(a_card({a_projector()}));
    other.frames(2);
    EXPECT_EQ(other.presenter.state(),
              "the projector at HDMI-A-1 is lit, 1280 x 800 at 60 Hz, because it cannot do the mode in the "
              "settings; "
              "choose 3D, side by side, in the projector's own menu; its range is unknown");
    EXPECT_EQ(other.presenter.condition().id, "display.other_mode");
    request = forced_on_hdmi();
    request.eyes = EyeLayout::TopBottom;
    PresentedExhibit blind(request);
    blind.presenter.connected(a_card({unseen_projector()}));
    blind.frames(5);
    EXPECT_TRUE(blind.says("choose 3D, top and bottom, in the projector's own menu"))
        << blind.presenter.state();
}

/// No flip of another picture is possible: the failure comes after the call.
TEST(PresenterOutput, RelightsAfterAQueuedFlipFails) {
    for (const KmsAnswer answer : {KmsAnswer::Refused, KmsAnswer::NotMaster, KmsAnswer::Gone}) {
        PresentedExhibit exhibit;
        exhibit.presenter.connected(a_card({a_projector()}));
        exhibit.frames(5);
        exhibit.kms.fails_later = answer;
        exhibit.frames(2);
        EXPECT_FALSE(exhibit.says("is lit"));
        exhibit.kms.fails_later = KmsAnswer::Done;
        exhibit.frames(100);
        EXPECT_TRUE(exhibit.says("is lit")) << exhibit.presenter.state();
        EXPECT_EQ(exhibit.kms.lights, 2);
    }
}

} // namespace
} // namespace frustumscreen::display
