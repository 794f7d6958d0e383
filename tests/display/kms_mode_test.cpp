#include "firmware_host/display/kms_mode.h"
#include "tests/display/fake_kms.h"

#include <gtest/gtest.h>

namespace frustumscreen::display {
namespace {

OutputRequest request(int width = 0, int height = 0, double hz = 0.0) {
    OutputRequest made;
    made.width = width;
    made.height = height;
    made.refresh_hz = hz;
    made.picture_width = 1280;
    made.picture_height = 800;
    return made;
}

ConnectorSeen with(std::vector<ModeTiming> modes) {
    ConnectorSeen connector = a_projector();
    connector.modes = std::move(modes);
    return connector;
}

TEST(KmsMode, ComputesTheRefreshRateFromTheTiming) {
    // CTA-861 formats 16 and 5.
    ModeTiming hd{148500, 1920, 2008, 2052, 2200, 0, 1080, 1084, 1089, 1125, 0, 0, false};
    EXPECT_DOUBLE_EQ(refresh_hz(hd), 60.0);
    ModeTiming halved{74250, 1920, 2008, 2052, 2200, 0, 1080, 1084, 1094, 1125, 0, mode_interlaced, false};
    EXPECT_DOUBLE_EQ(refresh_hz(halved), 60.0);
    EXPECT_EQ(refresh_hz({}), 0.0);
}

TEST(KmsMode, PrefersThePicturesSizeToThePreferredMode) {
    const auto modes = modes_to_try(
        with({a_mode(3840, 2160, 30.0, true), a_mode(1280, 800, 60.0), a_mode(640, 480, 60.0)}), request());
    ASSERT_EQ(modes.size(), 3U);
    EXPECT_EQ(modes[0].width, 1280);
    EXPECT_EQ(modes[1].width, 3840) << "then the preferred one";
    EXPECT_EQ(modes[2].width, 640);
    const auto without = modes_to_try(
        with({a_mode(1024, 768, 60.0), a_mode(1920, 1080, 60.0, true), a_mode(640, 480, 60.0)}), request());
    EXPECT_EQ(without[0].width, 1920) << "no mode of the picture's size";
    EXPECT_EQ(without[1].width, 1024) << "then by nearness to the picture";
}

TEST(KmsMode, ChoosesByRateThenByPreferenceAmongModesOfThePicturesSize) {
    const auto first = [](std::vector<ModeTiming> modes, const OutputRequest& asked = request()) {
        return modes_to_try(with(std::move(modes)), asked)[0];
    };
    EXPECT_NEAR(refresh_hz(first({a_mode(1280, 800, 75.0), a_mode(1280, 800, 60.0)})), 60.0, 0.1);
    EXPECT_NEAR(refresh_hz(first({a_mode(1280, 800, 120.0, true), a_mode(1280, 800, 60.0)})), 60.0, 0.1);
    EXPECT_NEAR(refresh_hz(first({a_mode(1280, 800, 60.0), a_mode(1280, 800, 59.81, true)})), 59.81, 0.01)
        << "VESA's two timings of it: the projector says which is its own";
    EXPECT_NEAR(refresh_hz(first({a_mode(1280, 800, 50.0), a_mode(1280, 800, 75.0, true)})), 75.0, 0.1);
    const ModeTiming halved = a_mode(1280, 800, 60.0, true, mode_interlaced);
    EXPECT_EQ(first({halved, a_mode(1024, 768, 60.0)}), halved) << "preferred, but not for its size";
    EXPECT_EQ(first({halved, a_mode(1280, 800, 75.0)}).flags, 0U);
    OutputRequest slower = request();
    slower.picture_hz = 50.0;
    EXPECT_NEAR(refresh_hz(first({a_mode(1280, 800, 60.0, true), a_mode(1280, 800, 50.0)}, slower)), 50.0,
                0.1);
}

TEST(KmsMode, PrefersTheRequestedModeToThePreferredOne) {
    const auto list =
        with({a_mode(1920, 1080, 60.0, true), a_mode(1280, 800, 59.81), a_mode(1280, 800, 74.93)});
    EXPECT_NEAR(refresh_hz(modes_to_try(list, request(1280, 800, 60.0))[0]), 59.81, 0.01);
    EXPECT_NEAR(refresh_hz(modes_to_try(list, request(1280, 800, 75.0))[0]), 74.93, 0.01);
    EXPECT_NEAR(refresh_hz(modes_to_try(list, request(1280, 800))[0]), 59.81, 0.01) << "60 Hz is usual";
    EXPECT_EQ(modes_to_try(list, request(1280, 800, 50.0))[0].width, 1920) << "not there: the preferred one";
    EXPECT_EQ(modes_to_try(list, request(1280, 800, 50.0))[1].width, 1280) << "then the nearest";
}

TEST(KmsMode, DistinguishesRatesThatDifferByAThousandth) {
    const auto list = with({a_mode(1920, 1080, 59.94), a_mode(1920, 1080, 60.0)});
    EXPECT_NEAR(refresh_hz(modes_to_try(list, request(1920, 1080, 60.0))[0]), 60.0, 0.01);
    EXPECT_NEAR(refresh_hz(modes_to_try(list, request(1920, 1080, 59.94))[0]), 59.94, 0.01);
}

TEST(KmsMode, InterlacedModesAreTheLastResort) {
    const auto list = with({a_mode(1920, 1080, 60.0, false, mode_interlaced), a_mode(720, 576, 50.0)});
    EXPECT_EQ(modes_to_try(list, request(1920, 1080))[0].width, 720);
    EXPECT_EQ(modes_to_try(with({list.modes[0]}), request(1920, 1080))[0].width, 1920);
}

TEST(KmsMode, IgnoresInvalidModes) {
    ModeTiming empty;
    ModeTiming no_clock = a_mode(1280, 800, 60.0);
    no_clock.clock_khz = 0;
    const ModeTiming stereo = a_mode(1920, 1080, 60.0, true, 1U << 14U);
    EXPECT_TRUE(modes_to_try(with({empty, no_clock, stereo}), request()).empty());
    EXPECT_TRUE(modes_to_try(with({}), request()).empty());
    EXPECT_TRUE(modes_to_try(with({}), request(1280, 800)).empty());
}

TEST(KmsMode, TakesAForcedModeFromTheListElseMakesOne) {
    OutputRequest forced = request(1280, 800, 60.0);
    forced.force = true;
    const auto bad_edid = with({a_mode(1024, 768, 60.0), a_mode(800, 600, 60.0)});
    const auto made = modes_to_try(bad_edid, forced);
    ASSERT_EQ(made.size(), 3U);
    EXPECT_EQ(made[0].width, 1280);
    EXPECT_EQ(made[0].height, 800);
    EXPECT_NEAR(refresh_hz(made[0]), 60.0, 0.5);
    EXPECT_EQ(modes_to_try(with({}), forced).size(), 1U) << "no EDID at all";
    const auto good = with({a_mode(1024, 768, 60.0, true), a_mode(1280, 800, 59.81)});
    EXPECT_EQ(modes_to_try(good, forced)[0], good.modes[1]);
    EXPECT_EQ(modes_to_try(good, forced).size(), 2U);
}

TEST(KmsMode, MakesTimingsOfTheStandards) {
    // VESA DMT 1.13: 1280 x 800 with reduced blanking, ID 1Bh; CVT gives identical values.
    const ModeTiming wide = make_mode(1280, 800, 60.0);
    EXPECT_EQ(wide.clock_khz, 71000U);
    EXPECT_EQ(wide.htotal, 1440);
    EXPECT_EQ(wide.vtotal, 823);
    EXPECT_EQ(wide.flags, mode_hsync_positive | mode_vsync_negative);
    // CTA-861 formats 4 and 16.
    EXPECT_EQ(make_mode(1280, 720, 60.0).clock_khz, 74250U);
    EXPECT_EQ(make_mode(1920, 1080, 60.0).clock_khz, 148500U);
    EXPECT_DOUBLE_EQ(refresh_hz(make_mode(1280, 720, 60.0)), 60.0);
    for (const double hz : {24.0, 50.0, 60.0, 75.0, 120.0}) {
        for (const auto& [width, height] : {std::pair{640, 480}, {1024, 768}, {1920, 1200}, {3840, 2160}}) {
            const ModeTiming mode = make_mode(width, height, hz);
            EXPECT_NEAR(refresh_hz(mode), hz, 0.02 * hz) << width; // CVT quantises the clock to 250 kHz
            EXPECT_TRUE(mode.width <= mode.hsync_start && mode.hsync_start < mode.hsync_end &&
                        mode.hsync_end < mode.htotal);
            EXPECT_TRUE(mode.height < mode.vsync_start && mode.vsync_start < mode.vsync_end &&
                        mode.vsync_end < mode.vtotal);
        }
    }
}

/// Connectors that are less than a projector that is there.
class ConnectorChoiceTest : public testing::Test {
protected:
    ConnectorChoiceTest() {
        panel.built_in = true;
        off.plugged = Plugged::No;
        unsure.plugged = Plugged::Unknown;
        mute.modes.clear();
    }
    ConnectorSeen panel = a_projector(1, "eDP-1"), off = a_projector(2, "HDMI-A-1"),
                  unsure = a_projector(3, "VGA-1"), mute = a_projector(4, "DP-1");
};

TEST_F(ConnectorChoiceTest, PrefersAProjectorToAPanelAndToAnUnknownConnector) {
    const ConnectorSeen there = a_projector(5, "DP-2");
    const auto chosen = [](std::vector<ConnectorSeen> all, const OutputRequest& asked) {
        const CardSeen card = a_card(std::move(all));
        const ConnectorSeen* connector = choose_connector(card, asked);
        return connector != nullptr ? connector->name : std::string("none");
    };
    EXPECT_EQ(chosen({panel, off, unsure, mute, there}, request()), "DP-2");
    EXPECT_EQ(chosen({unsure, panel, off, mute}, request()), "eDP-1");
    EXPECT_EQ(chosen({off, unsure, mute}, request()), "VGA-1");
    EXPECT_EQ(chosen({off, mute}, request()), "none");
    EXPECT_EQ(chosen({}, request()), "none");
    OutputRequest named = request();
    named.connector = "eDP-1";
    EXPECT_EQ(chosen({there, panel}, named), "eDP-1");
    named.connector = "HDMI-A-1";
    EXPECT_EQ(chosen({there, off}, named), "none") << "the one that was named, or none";
    OutputRequest forced = request(1280, 800);
    forced.force = true;
    EXPECT_EQ(chosen({off, mute}, forced), "DP-1");
    forced.connector = "HDMI-A-1";
    EXPECT_EQ(chosen({there, mute, off}, forced), "HDMI-A-1") << "named and forced: whatever it says";
    forced.width = 0;
    EXPECT_EQ(chosen({there, mute, off}, forced), "none") << "no mode to force";
}

TEST_F(ConnectorChoiceTest, RanksACardWithAProjectorFirst) {
    EXPECT_EQ(rank_of(a_card({panel, a_projector(5, "DP-2")}), request()), CardRank::Projector);
    EXPECT_EQ(rank_of(a_card({off, panel}), request()), CardRank::Panel);
    for (const ConnectorSeen& nothing_certain : {off, unsure, mute}) {
        EXPECT_EQ(rank_of(a_card({nothing_certain}), request()), CardRank::NothingCertain);
    }
    EXPECT_EQ(rank_of(a_card({}), request()), CardRank::NothingCertain);
    OutputRequest named = request();
    named.connector = "HDMI-A-1";
    EXPECT_EQ(rank_of(a_card({off, a_projector(5, "DP-2")}), named), CardRank::NothingCertain);
    EXPECT_EQ(rank_of(a_card({a_projector(5, "DP-2")}), named), CardRank::WithoutTheConnectorNamed);
    EXPECT_EQ(rank_of(a_card({a_projector()}), named), CardRank::Projector);
    EXPECT_LT(CardRank::Projector, CardRank::Panel);
    EXPECT_LT(CardRank::Panel, CardRank::NothingCertain);
    EXPECT_LT(CardRank::NothingCertain, CardRank::WithoutTheConnectorNamed);
}

TEST(KmsMode, AddsUsualModesOnlyToAProjectorWithoutAnEdid) {
    ConnectorSeen off = with({});
    off.plugged = Plugged::No;
    CardSeen card = a_card({with({}), with({a_mode(640, 480, 60.0)}), off});
    add_usual_modes(card);
    const auto modes = modes_to_try(card.connectors[0], {});
    ASSERT_EQ(modes.size(), 3U);
    EXPECT_EQ(modes.front().width, 1280);
    EXPECT_EQ(modes.front().clock_khz, 74250U) << "CTA-861's format 4";
    EXPECT_EQ(card.connectors[1].modes.size(), 1U);
    EXPECT_TRUE(card.connectors[2].modes.empty());
}

ModeTiming flagged(ModeTiming mode, std::uint32_t layout) {
    mode.flags |= layout;
    return mode;
}

constexpr std::uint32_t frame_packing = 1U << 14U;

TEST(KmsMode, PrefersTheHdmi3DTwinForTwoHalves) {
    const ModeTiming plain = a_mode(1280, 800, 60.0, true);
    const ModeTiming other = a_mode(1024, 768, 60.0);
    ModeTiming twin = flagged(plain, mode_side_by_side);
    twin.preferred = false; // whether the kernel copies this from the plain mode or not
    const auto list = with({flagged(other, mode_side_by_side), flagged(plain, mode_top_bottom),
                            flagged(plain, frame_packing), twin, other, plain});
    OutputRequest halves = request();
    halves.eyes = EyeLayout::SideBySide;
    EXPECT_EQ(modes_to_try(list, halves),
              (std::vector<ModeTiming>{twin, plain, flagged(other, mode_side_by_side), other}));
    halves.eyes = EyeLayout::TopBottom;
    EXPECT_EQ(modes_to_try(list, halves),
              (std::vector<ModeTiming>{flagged(plain, mode_top_bottom), plain, other}));
    for (const EyeLayout eyes : {EyeLayout::One, EyeLayout::InTurn}) {
        halves.eyes = eyes;
        EXPECT_EQ(modes_to_try(list, halves), (std::vector<ModeTiming>{plain, other}))
            << "never for another picture";
    }
    halves.eyes = EyeLayout::SideBySide;
    EXPECT_EQ(modes_to_try(with({plain, flagged(a_mode(1280, 800, 50.0), mode_side_by_side)}), halves),
              std::vector<ModeTiming>{plain})
        << "not of another timing";
    halves.width = 1024;
    halves.height = 768;
    EXPECT_EQ(modes_to_try(list, halves)[0], flagged(other, mode_side_by_side)) << "the requested one's";
}

TEST(KmsMode, PrefersAFastModeToThePicturesSizeForAlternatingEyes) {
    OutputRequest turns = request();
    turns.eyes = EyeLayout::InTurn;
    turns.fast = true;
    turns.picture_hz = 120.0;
    const auto first = [&turns](std::vector<ModeTiming> modes) {
        return modes_to_try(with(std::move(modes)), turns)[0];
    };
    const ModeTiming usual = a_mode(1280, 800, 60.0, true);
    EXPECT_NEAR(refresh_hz(first({usual, a_mode(1280, 800, 120.0)})), 120.0, 0.1);
    EXPECT_EQ(first({usual, a_mode(1024, 768, 120.0), a_mode(640, 480, 120.0)}).width, 1024);
    EXPECT_EQ(first({usual, a_mode(1280, 800, 85.0)}), usual) << "none is fast enough";
    EXPECT_NEAR(refresh_hz(first({usual, a_mode(1280, 800, 144.0), a_mode(1280, 800, 119.9)})), 119.9, 0.1);
    turns.width = 1280;
    turns.height = 800;
    EXPECT_NEAR(refresh_hz(first({usual, a_mode(1024, 768, 120.0)})), 60.0, 0.1) << "the settings decide";
    EXPECT_NEAR(refresh_hz(first({usual, a_mode(1280, 800, 120.0)})), 120.0, 0.1);
}

} // namespace
} // namespace frustumscreen::display
