#include "tests/folders.h"
#include "tests/settings/settings_text.h"

#include <filesystem>

namespace frustumscreen::settings {
namespace {

void expect_same_pose(const geometry::RigidTransform& a, const geometry::RigidTransform& b) {
    for (const glm::dvec3& p :
         {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
        EXPECT_LT(glm::distance(a.point(p), b.point(p)), 1e-12);
    }
}

TEST(Settings, TheShippedFileEqualsTheDefaults) {
    const Settings defaults;
    const Settings shipped = parsed(shipped_text());
    EXPECT_EQ(shipped.projector.pinhole.width, defaults.projector.pinhole.width);
    EXPECT_EQ(shipped.projector.pinhole.height, defaults.projector.pinhole.height);
    EXPECT_NEAR(shipped.projector.pinhole.fx, defaults.projector.pinhole.fx, 1e-9);
    EXPECT_NEAR(shipped.projector.pinhole.fy, defaults.projector.pinhole.fy, 1e-9);
    EXPECT_EQ(shipped.projector.pinhole.cx, defaults.projector.pinhole.cx);
    EXPECT_EQ(shipped.projector.pinhole.cy, defaults.projector.pinhole.cy);
    EXPECT_EQ(shipped.projector.refresh_hz, defaults.projector.refresh_hz);
    EXPECT_EQ(shipped.render.error_tolerance_px, defaults.render.error_tolerance_px);
    expect_same_pose(shipped.projector.table_from_projector, defaults.projector.table_from_projector);
    EXPECT_EQ(shipped.prop.kind, defaults.prop.kind);
    EXPECT_EQ(shipped.prop.base_m, defaults.prop.base_m);
    EXPECT_EQ(shipped.prop.top_m, defaults.prop.top_m);
    EXPECT_EQ(shipped.prop.height_m, defaults.prop.height_m);
    EXPECT_EQ(shipped.table.width_m, defaults.table.width_m);
    EXPECT_EQ(shipped.table.depth_m, defaults.table.depth_m);
    EXPECT_EQ(shipped.eye.default_m, defaults.eye.default_m);
    EXPECT_EQ(shipped.eye.lowest_elevation_deg, defaults.eye.lowest_elevation_deg);
    EXPECT_EQ(shipped.eye.nearest_m, defaults.eye.nearest_m);
    EXPECT_EQ(shipped.eye.farthest_m, defaults.eye.farthest_m);
    EXPECT_EQ(shipped.eye.tracked, defaults.eye.tracked);
    EXPECT_EQ(shipped.exhibit.captions, defaults.exhibit.captions);
    EXPECT_EQ(shipped.tracker.kind, defaults.tracker.kind);
    EXPECT_EQ(shipped.tracker.seed, defaults.tracker.seed);
    EXPECT_EQ(shipped.tracker.hemisphere, defaults.tracker.hemisphere);
    EXPECT_EQ(shipped.tracker.display_latency_ms, defaults.tracker.display_latency_ms);
    EXPECT_EQ(shipped.exhibit.language, defaults.exhibit.language);
    EXPECT_EQ(shipped.exhibit.caption_height_m, defaults.exhibit.caption_height_m);
}

TEST(Settings, ParsesAUsbTrackerAndItsHemisphere) {
    const Settings usb = parsed("[tracker]\nkind = \"usb\"\nhemisphere = [0, 0, -1]\n");
    EXPECT_EQ(usb.tracker.kind, TrackerKind::Usb);
    EXPECT_EQ(usb.tracker.hemisphere, glm::dvec3(0, 0, -1));
    EXPECT_EQ(name_of(TrackerKind::Usb), "usb");
}

TEST(Settings, ParsesASpaceMouseAndTheReplaySpeed) {
    EXPECT_EQ(parsed("[tracker]\nkind = \"spacemouse\"\n").tracker.kind, TrackerKind::SpaceMouse);
    EXPECT_EQ(name_of(TrackerKind::SpaceMouse), "spacemouse");
    const Settings replay =
        parsed("[tracker]\nkind = \"replay\"\nposes = \"fault.rec\"\nreplay_speed = 0.5\n");
    EXPECT_EQ(replay.tracker.replay_speed, 0.5);
    EXPECT_EQ(Settings().tracker.replay_speed, 1.0);
}

TEST(Settings, ParsesAFixedScene) {
    const Settings fixed =
        parsed("[eye]\ntracked = false\n[tracker]\nkind = \"none\"\n[exhibit]\ncaptions = false\n");
    EXPECT_FALSE(fixed.eye.tracked);
    EXPECT_EQ(fixed.tracker.kind, TrackerKind::None);
    EXPECT_FALSE(fixed.exhibit.captions);
}

TEST(Settings, AnEmptyFileGivesTheDefaults) {
    const Settings settings = parsed("");
    EXPECT_NEAR(settings.projector.pinhole.fx, Settings().projector.pinhole.fx, 1e-9);
    expect_same_pose(settings.projector.table_from_projector, Settings().projector.table_from_projector);
}

/// Pixel of a table point, by the pinhole of the settings.
glm::dvec2 pixel_of(const Settings& settings, const glm::dvec3& table_point) {
    const auto pixel = settings.projector.pinhole.pixel(
        settings.projector.table_from_projector.inverse().point(table_point));
    EXPECT_TRUE(pixel);
    return pixel.value_or(glm::dvec2(-1.0));
}

TEST(Settings, TheShippedPictureExactlyCoversTheTableWithTheFarSideOnTop) {
    const Settings settings = parsed(shipped_text());
    EXPECT_LT(glm::distance(pixel_of(settings, {-0.4, 0.25, 0}), glm::dvec2(0, 0)), 1e-9);
    EXPECT_LT(glm::distance(pixel_of(settings, {0.4, 0.25, 0}), glm::dvec2(1920, 0)), 1e-9);
    EXPECT_LT(glm::distance(pixel_of(settings, {0.4, -0.25, 0}), glm::dvec2(1920, 1200)), 1e-9);
    EXPECT_LT(glm::distance(pixel_of(settings, {0, 0, 0.5}), glm::dvec2(960, 600)), 1e-9);
}

TEST(Settings, TheNearPropCoversAQuarterOfThePicture) {
    const auto loaded = load_settings(source_dir() + "/config/near.toml");
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Settings& near = **loaded;
    const double half = near.prop.base_m / 2;
    const glm::dvec2 side = glm::abs(pixel_of(near, {half, half, 0}) - pixel_of(near, {-half, -half, 0}));
    EXPECT_NEAR(side.x * side.y / (1280.0 * 800.0), 0.25, 0.01);
    EXPECT_EQ(near.prop.base_m, 0.16);
}

/// Each example is read as a kiosk reads it.
TEST(Settings, EveryExampleLoads) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() + "/config")) {
        if (entry.path().extension() == ".toml") {
            const auto loaded = load_settings(entry.path());
            EXPECT_TRUE(loaded) << loaded.error().message;
            ++count;
        }
    }
    EXPECT_GE(count, 6U);
}

TEST(Settings, TheStereoExampleShowsTwoHalvesOfACubeInTheHand) {
    const CheckedSettings settings = load_settings(source_dir() + "/config/cube_stereo.toml").value();
    EXPECT_EQ(stereo_of(*settings), Stereo::SideBySide);
    EXPECT_EQ(settings->prop.zone, PropZone::Hand);
    EXPECT_EQ(settings->tracker.kind, TrackerKind::Usb) << "its head's sensor says where each eye is";
    // The picture exactly covers the table.
    EXPECT_LT(glm::distance(pixel_of(*settings, {-0.4, 0.225, 0}), glm::dvec2(0, 0)), 1e-9);
    EXPECT_LT(glm::distance(pixel_of(*settings, {0.4, -0.225, 0}), glm::dvec2(1920, 1080)), 1e-9);
}

TEST(Settings, AcceptsAWholeNumberAsANumber) {
    EXPECT_EQ(parsed("[table]\nwidth_m = 1\n").table.width_m, 1.0);
}

TEST(Settings, ParsesFocalLengthsAndLensShift) {
    const Settings settings =
        parsed("[projector]\nwidth = 1000\nheight = 500\nfx = 1500\nfy = 1400\ncx = 480.5\ncy = 300\n");
    const geometry::Pinhole& p = settings.projector.pinhole;
    EXPECT_EQ(p.width, 1000);
    EXPECT_EQ(p.height, 500);
    EXPECT_EQ(p.fx, 1500.0);
    EXPECT_EQ(p.fy, 1400.0);
    EXPECT_EQ(p.cx, 480.5);
    EXPECT_EQ(p.cy, 300.0);
}

TEST(Settings, TheAimLandsInThePrincipalPointAndThePictureStandsUpright) {
    const Settings settings = parsed("[projector]\nposition_m = [0.3, 0.4, 1.0]\naim_m = [0.1, 0.0, 0.0]\n");
    EXPECT_LT(glm::distance(pixel_of(settings, {0.1, 0, 0}), glm::dvec2(960, 600)), 1e-9);
    EXPECT_NEAR(pixel_of(settings, {0.1, 0.05, 0}).x, pixel_of(settings, {0.1, -0.05, 0}).x, 30.0);
    EXPECT_LT(pixel_of(settings, {0.1, 0.05, 0}).y, 600.0);
    EXPECT_GT(pixel_of(settings, {0.15, 0, 0}).x, 960.0);
}

TEST(Settings, RollTurnsThePictureClockwiseAsTheProjectorSeesIt) {
    const Settings settings = parsed("[projector]\nroll_deg = 90\n");
    // The picture's right edge lies where its bottom was: at the visitor.
    EXPECT_GT(pixel_of(settings, {0, -0.1, 0}).x, 960.0 + 100.0);
    EXPECT_LT(pixel_of(settings, {0.1, 0, 0}).y, 600.0 - 100.0);
}

TEST(Settings, TheTwoWaysToPlaceTheProjectorAgree) {
    const Settings by_matrix = parsed("[projector]\ntable_from_projector = "
                                      "[1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0.05,0.02,1.3,1]\n");
    const Settings by_aim = parsed("[projector]\nposition_m = [0.05, 0.02, 1.3]\n");
    expect_same_pose(by_matrix.projector.table_from_projector, by_aim.projector.table_from_projector);
}

TEST(Settings, ACubeHasEqualEdgesAndTheHandZone) {
    const Settings settings = parsed("[prop]\nkind = \"cube\"\nbase_m = 0.12\n");
    EXPECT_EQ(settings.prop.kind, PropKind::Cube);
    EXPECT_EQ(settings.prop.top_m, 0.12);
    EXPECT_EQ(settings.prop.height_m, 0.12);
    EXPECT_EQ(settings.prop.zone, PropZone::Hand);
    EXPECT_EQ(parsed("[prop]\nkind = \"cube\"\nzone = \"table\"\n").prop.zone, PropZone::Table);
    EXPECT_EQ(parsed("[prop]\nzone = \"hand\"\n").prop.zone, PropZone::Hand);
    EXPECT_EQ(parsed("").prop.zone, PropZone::Table);
}

TEST(Settings, PathsAreRelativeToTheSettingsFile) {
    const Settings settings = parsed("[tracker]\nkind = \"replay\"\nposes = \"walk.csv\"\n"
                                     "[exhibit]\npacks = [\"../a.fspack\", \"/b.fspack\"]\n");
    EXPECT_EQ(settings.tracker.kind, TrackerKind::Replay);
    EXPECT_EQ(settings.tracker.poses, std::filesystem::path("set/walk.csv"));
    ASSERT_EQ(settings.exhibit.packs.size(), 2U);
    EXPECT_EQ(settings.exhibit.packs[0], std::filesystem::path("a.fspack"));
    EXPECT_EQ(settings.exhibit.packs[1], std::filesystem::path("/b.fspack"));
}

TEST(Settings, ParsesTheScriptInOrder) {
    const Settings settings =
        parsed("[panel]\nscript = [{at_s = 1, button = 0}, {at_s = 2.5}]\nrepeat_s = 4\n");
    ASSERT_EQ(settings.panel.script.size(), 2U);
    EXPECT_EQ(settings.panel.script[0].button, 0);
    EXPECT_EQ(settings.panel.script[1].at_s, 2.5);
    EXPECT_EQ(settings.panel.script[1].button, 1);
    EXPECT_EQ(settings.panel.repeat_s, 4.0);
}

TEST(Settings, ParsesTheDisplayMode) {
    const Settings settings = parsed(
        "[display]\ncard = \"card1\"\nconnector = \"HDMI-A-2\"\nmode = \"1920x1200@59.95\"\nforce = true\n");
    EXPECT_EQ(settings.display.kind, DisplayKind::Kms);
    EXPECT_EQ(settings.display.card, "card1");
    EXPECT_EQ(settings.display.connector, "HDMI-A-2");
    EXPECT_EQ(settings.display.mode.width, 1920);
    EXPECT_EQ(settings.display.mode.height, 1200);
    EXPECT_EQ(settings.display.mode.refresh_hz, 59.95);
    EXPECT_TRUE(settings.display.force);
    for (const char* text : {"preferred", "1280x800", "1280x800@60", "1920x1200@59.95"}) {
        const auto mode = parse_display_mode(text);
        ASSERT_TRUE(mode) << text;
        EXPECT_EQ(text_of(*mode), text);
    }
    for (const char* text : {"", "x", "1280", "1280x", "x800", "1280x800@", "1280x800@nan", "1280x800@inf",
                             "-1280x800", "1280x800x60", "99999999999x800", "1280x800@60Hz", "Preferred"}) {
        EXPECT_FALSE(parse_display_mode(text)) << text;
    }
}

TEST(Settings, ParsesGpioAndKeyboardButtons) {
    const Settings settings =
        parsed("[panel]\nkind = \"gpio\"\nchip = \"cp2112_gpio\"\nlines = [\"PREVIOUS\", \"5\"]\n"
               "bias = \"as-is\"\nactive_low = false\ndebounce_ms = 12.5\nstuck_s = 60.0\n");
    EXPECT_EQ(settings.panel.kind, PanelKind::Gpio);
    EXPECT_EQ(settings.panel.chip, "cp2112_gpio");
    EXPECT_EQ(settings.panel.lines, (std::vector<std::string>{"PREVIOUS", "5"}));
    EXPECT_EQ(settings.panel.bias, LineBias::AsIs);
    EXPECT_FALSE(settings.panel.active_low);
    EXPECT_EQ(settings.panel.debounce_ms, 12.5);
    EXPECT_EQ(settings.panel.stuck_s, 60.0);
    EXPECT_EQ(settings.panel.buttons(), 2U);
    EXPECT_EQ(parsed("[panel]\nkind = \"gpio\"\nlines = [\"4\"]\nlamps = [\"0\"]\n").panel.lamps,
              std::vector<std::string>{"0"});
    const Settings keys =
        parsed("[panel]\nkind = \"keys\"\ndevice = \"Bench keyboard\"\nkeys = [\"KEY_A\", \"KEY_B\"]\n");
    EXPECT_EQ(keys.panel.kind, PanelKind::Keys);
    EXPECT_EQ(keys.panel.device, "Bench keyboard");
    EXPECT_EQ(keys.panel.keys, (std::vector<std::string>{"KEY_A", "KEY_B"}));
    EXPECT_EQ(keys.panel.buttons(), 2U);
}

} // namespace
} // namespace frustumscreen::settings
