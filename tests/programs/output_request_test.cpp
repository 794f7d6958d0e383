// The display that is asked for, for each layout of the eyes' pictures.
#include "app/programs/devices/wiring.h"
#include "app/scene/stereo.h"

#include <gtest/gtest.h>

namespace frustumscreen::programs {
namespace {

settings::Settings settings_with(settings::Stereo stereo) {
    settings::Settings settings;
    settings.projector.pinhole = settings.projector.pinhole.scaled_to(640, 400);
    settings.eye.stereo = stereo;
    return settings;
}

TEST(OutputRequestOfSettings, AsksForTheModeOfTheProjectorAndTheLayoutOfThePicture) {
    using display::EyeLayout;
    using settings::Stereo;
    for (const auto& [stereo, eyes] : {std::pair{Stereo::Off, EyeLayout::One},
                                       {Stereo::SideBySide, EyeLayout::SideBySide},
                                       {Stereo::TopBottom, EyeLayout::TopBottom},
                                       {Stereo::FrameSequential, EyeLayout::InTurn},
                                       {Stereo::Anaglyph, EyeLayout::One}}) {
        const settings::Settings settings = settings_with(stereo);
        const display::OutputRequest request = output_request(settings);
        EXPECT_EQ(request.eyes, eyes) << name_of(stereo);
        EXPECT_EQ(request.picture_width, 640);
        EXPECT_EQ(request.picture_height, 400) << "of the projector, also where the picture holds two";
        EXPECT_EQ(request.picture_hz, stereo == Stereo::FrameSequential ? 120.0 : 60.0);
        EXPECT_EQ(request.fast, stereo == Stereo::FrameSequential);
        const PixelSize drawn = scene::stereo_layout(settings).display;
        EXPECT_EQ(drawn, (PixelSize{request.picture_width, request.picture_height * stacked(request.eyes)}));
        const auto headless = make_display(settings, true);
        ASSERT_TRUE(headless) << headless.error().message;
        EXPECT_EQ((PixelSize{(*headless)->width(), (*headless)->height()}), drawn);
    }
}

TEST(OutputRequestOfSettings, TheScreenHasItsOwnConnectorSizeRateAndLayout) {
    settings::Settings settings = settings_with(settings::Stereo::SideBySide);
    settings.screen.room = "room.toml";
    settings.screen.connector = "DP-1";
    settings.screen.width = 320;
    settings.screen.height = 180;
    settings.screen.refresh_hz = 50.0;
    settings.screen.stereo = settings::OutputStereo::FrameSequential;
    const display::OutputRequest request = screen_request(settings);
    EXPECT_EQ(request.connector, "DP-1");
    EXPECT_EQ(request.width, 0) << "another mode is scaled";
    EXPECT_EQ(request.picture_width, 320);
    EXPECT_EQ(request.picture_height, 180);
    EXPECT_EQ(request.picture_hz, 100.0);
    EXPECT_EQ(request.eyes, display::EyeLayout::InTurn);
    EXPECT_EQ(output_request(settings).eyes, display::EyeLayout::SideBySide);
    const auto projector = make_display(settings, true);
    ASSERT_TRUE(projector) << projector.error().message;
    const auto screen = make_screen(settings, **projector);
    ASSERT_TRUE(screen) << screen.error().message;
    EXPECT_EQ((*screen)->width(), 320);
    EXPECT_EQ((*screen)->height(), 2 * 180) << "both eyes' pictures";
    EXPECT_TRUE((*projector)->make_current());
}

TEST(OutputRequestOfSettings, ProjectorStereoOverridesEyeStereo) {
    settings::Settings settings = settings_with(settings::Stereo::SideBySide);
    settings.projector.stereo = settings::OutputStereo::TopBottom;
    EXPECT_EQ(output_request(settings).eyes, display::EyeLayout::TopBottom);
    settings.projector.stereo = settings::OutputStereo::Off;
    EXPECT_EQ(output_request(settings).eyes, display::EyeLayout::One);
}

} // namespace
} // namespace frustumscreen::programs
