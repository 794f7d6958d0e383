// The table [screen]: every key, the corners that make a screen, and the settings of two outputs beside each other.
#include "app/settings/config_json.h"
#include "app/settings/missing_files.h"
#include "firmware_host/base/json.h"
#include "tests/settings/settings_text.h"

#include <fmt/format.h>

#include <array>
#include <sstream>

namespace frustumscreen::settings {
namespace {

/// A screen with these lines.
std::string screen(const std::string& lines = {}) {
    return "[screen]\nroom = \"hall/room.toml\"\n" + lines + "\n";
}
std::string corners(const std::array<glm::dvec3, 4>& at) {
    std::string text = "corners_m = [";
    for (const glm::dvec3& each : at) {
        text += fmt::format("[{}, {}, {}],", each.x, each.y, each.z);
    }
    return text + "]\n";
}
constexpr glm::dvec3 top_left(-0.6, 0.7, 0.85);
constexpr glm::dvec3 top_right(0.6, 0.7, 0.85);
constexpr glm::dvec3 bottom_right(0.6, 0.7, 0.175);
constexpr glm::dvec3 bottom_left(-0.6, 0.7, 0.175);

void expect_refused(const std::string& text, const std::vector<std::string>& words) {
    const std::string message = refusal(text);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const std::string& word : words) {
        EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' not in: " << message;
    }
}

TEST(ScreenSettings, NoScreenExistsWithoutARoom) {
    EXPECT_FALSE(parsed("").screen.exists());
    EXPECT_FALSE(parsed("[screen]\nwidth = 64\n").screen.exists());
    EXPECT_FALSE(parsed(shipped_text()).screen.exists());
    // A screen that is not there cannot be wrong, apart from its types.
    EXPECT_EQ(refusal("[screen]\n" + corners({top_right, top_left, bottom_left, bottom_right})), "");
    expect_refused("[screen]\nwidth = 1.5\n", {":2: screen.width is 1.5"});
}

TEST(ScreenSettings, ParsesEveryKey) {
    const ScreenSettings read =
        parsed(
            screen(corners({glm::dvec3(-1, 1, 2), glm::dvec3(1, 1, 2), glm::dvec3(1, 1, 1),
                            glm::dvec3(-1, 1, 1)}) +
                   "width = 3840\nheight = 1920\nrefresh_hz = 120\ncard = \"card1\"\nconnector = \"DP-2\"\n"
                   "stereo = \"top_bottom\""))
            .screen;
    EXPECT_TRUE(read.exists());
    EXPECT_EQ(read.room, "set/hall/room.toml");
    EXPECT_EQ(read.corners_m[0], glm::dvec3(-1, 1, 2));
    EXPECT_EQ(read.corners_m[2], glm::dvec3(1, 1, 1));
    EXPECT_EQ(read.width, 3840);
    EXPECT_EQ(read.height, 1920);
    EXPECT_EQ(read.refresh_hz, 120.0);
    EXPECT_EQ(read.card, "card1");
    EXPECT_EQ(read.connector, "DP-2");
    EXPECT_EQ(read.stereo, OutputStereo::TopBottom);
}

TEST(ScreenSettings, StereoDefaultsToTheEyesLayout) {
    EXPECT_EQ(screen_stereo_of(parsed(screen() + "[eye]\nstereo = \"anaglyph\"\n")), Stereo::Anaglyph);
    const Settings own = parsed(screen("stereo = \"off\"") + "[eye]\nstereo = \"anaglyph\"\n");
    EXPECT_EQ(screen_stereo_of(own), Stereo::Off);
    EXPECT_EQ(stereo_of(own), Stereo::Anaglyph); // the projector's
    EXPECT_EQ(screen_stereo_of(parsed(screen("stereo = \"side_by_side\""))), Stereo::SideBySide);
}

/// The lines that kiosk.toml shows in comments are a screen.
TEST(ScreenSettings, CommentedExampleOfTheShippedFileParses) {
    std::istringstream lines(shipped_text());
    std::string text;
    bool inside = false;
    for (std::string line; std::getline(lines, line);) {
        inside = (inside || line == "# [screen]") && line.starts_with("# ");
        text += (inside ? line.substr(2) : line) + "\n";
    }
    const Settings settings = parsed(text);
    EXPECT_EQ(settings.screen.room, "set/hall/room.toml");
    EXPECT_EQ(settings.screen.connector, "DP-1");
    const ScreenSettings usual;
    EXPECT_EQ(settings.screen.corners_m, usual.corners_m);
    EXPECT_EQ(settings.screen.width, usual.width);
    EXPECT_EQ(settings.screen.height, usual.height);
    EXPECT_EQ(settings.screen.refresh_hz, usual.refresh_hz);
    EXPECT_EQ(settings.screen.card, usual.card);
    EXPECT_EQ(settings.screen.stereo, usual.stereo);
}

TEST(ScreenCorners, MayBeOffByOneMillimetreButNotTen) {
    for (const glm::dvec3& way : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
        for (std::size_t which = 0; which < 4; ++which) {
            std::array<glm::dvec3, 4> at{top_left, top_right, bottom_right, bottom_left};
            at[which] += 0.001 * way;
            EXPECT_EQ(refusal(screen(corners(at))), "") << which;
            at[which] += 0.009 * way;
            expect_refused(screen(corners(at)), {":3: screen.corners_m is not a rectangle: it is ",
                                                 "mm off; allowed are at "
                                                 "most 2.4 mm",
                                                 "[settings.screen_no_rectangle]"});
        }
    }
}

TEST(ScreenCorners, MayLeanAndStandOnTheirSide) {
    EXPECT_EQ(refusal(screen(corners({bottom_left, top_left, top_right, bottom_right}))),
              ""); // turned by a quarter
    EXPECT_EQ(refusal(screen(corners({bottom_right, bottom_left, top_left, top_right}))), ""); // upside down
    // It lies flat, 10 cm behind the prop, and shows what is below.
    EXPECT_EQ(refusal(screen(corners({glm::dvec3(-0.5, 0.9, 0), glm::dvec3(0.5, 0.9, 0),
                                      glm::dvec3(0.5, 0.3, 0), glm::dvec3(-0.5, 0.3, 0)}))),
              "");
}

TEST(ScreenCorners, InAnotherOrderAreRefused) {
    const std::array<std::array<glm::dvec3, 4>, 4> crossed{
        {{top_left, top_right, bottom_left, bottom_right},
         {top_left, bottom_right, top_right, bottom_left},
         {top_right, bottom_left, top_left, bottom_right},
         {top_left, top_left, bottom_right, bottom_right}}};
    for (const auto& at : crossed) {
        EXPECT_NE(refusal(screen(corners(at))), "");
    }
    // Mirrored: the people would see its back.
    for (const auto& at : {std::array{top_right, top_left, bottom_left, bottom_right},
                           std::array{bottom_left, bottom_right, top_right, top_left}}) {
        expect_refused(screen(corners(at)),
                       {":3: screen.corners_m looks away from eye.default_m, so people there see its back; "
                        "allowed are top left, top right, bottom right, bottom left",
                        "[settings.screen_looks_away]"});
    }
    // The eye behind it, or on its plane.
    expect_refused(screen() + "[eye]\ndefault_m = [0, 0.8, 0.5]\n", {"screen.corners_m looks away"});
    expect_refused(screen() + "[eye]\ndefault_m = [0, 0.7, 0.5]\n", {"screen.corners_m looks away"});
}

TEST(ScreenCorners, TooSmallOrMistypedAreRefused) {
    expect_refused(
        screen(corners({glm::dvec3(0, 0.7, 0.84), glm::dvec3(0.04, 0.7, 0.84), glm::dvec3(0.04, 0.7, 0.4),
                        glm::dvec3(0, 0.7, 0.4)})),
        {":3: screen.corners_m has sides of 0.040 and 0.440 metres; allowed are at least 0.05 each",
         "[settings.screen_size]"});
    expect_refused(screen(corners({top_left, top_left, top_left, top_left})),
                   {"has sides of 0.000 and 0.000"});
    expect_refused(
        screen("corners_m = [[0, 1, 0], [1, 1, 0], [1, 1, 1]]"),
        {":3: screen.corners_m is a list of 3; allowed is a list of 4 points, each of 3 numbers, [x, y, z]"});
    expect_refused(screen("corners_m = [[0, 1, 0], [1, 1, 0], [1, 1], [0, 0, 0]]"),
                   {":3: screen.corners_m has a list of 2 as number 3; allowed is a list of 4 points",
                    "[settings.points]"});
    expect_refused(screen("corners_m = 5"), {":3: screen.corners_m is 5"});
    for (const char* none : {"nan", "inf", "-inf", "1e9", "\"0\""}) {
        expect_refused(screen(fmt::format("corners_m = [[0, {}, 0], [1, 1, 0], [1, 1, 1], [0, 0, 0]]", none)),
                       {":3: screen.corners_m[0][1] is ", "allowed are -10 to 10 metres"});
    }
}

TEST(ScreenOutput, MustDifferFromTheProjectorsConnector) {
    const auto both = [](const std::string& display, const std::string& of_screen) {
        return "[display]\n" + display + "\n" + screen(of_screen);
    };
    EXPECT_EQ(refusal(both("", "")), ""); // both "any"
    EXPECT_EQ(refusal(both("connector = \"HDMI-A-1\"", "connector = \"DP-1\"")), "");
    expect_refused(
        both("connector = \"DP-1\"", "connector = \"DP-1\""),
        {":5: screen.connector is \"DP-1\", and display.connector is the same; name two connectors",
         "[settings.screen_same_connector]"});
    expect_refused(both("connector = \"DP-1\"\ncard = \"card0\"", "connector = \"DP-1\""),
                   {"screen.connector"});
    EXPECT_EQ(
        refusal(both("connector = \"DP-1\"\ncard = \"card0\"", "connector = \"DP-1\"\ncard = \"card1\"")),
        "");
}

TEST(ScreenOutput, InvalidSizeAndStereoAreRefused) {
    expect_refused(
        screen("width = 1921\nstereo = \"side_by_side\""),
        {":4: screen.stereo is \"side_by_side\", and screen.width is 1921", "[settings.stereo_odd_width]"});
    expect_refused(
        screen("height = 1081") + "[eye]\nstereo = \"top_bottom\"\n",
        {"eye.stereo is \"top_bottom\", and screen.height is 1081", "[settings.stereo_odd_height]"});
    EXPECT_EQ(refusal(screen("height = 1081\nstereo = \"side_by_side\"")), "");
    expect_refused(screen("width = 63"), {":3: screen.width is 63", "64 to 8192"});
    expect_refused(screen("stereo = \"3d\""), {":3: screen.stereo", "\"as_eye\""});
    expect_refused(screen("rooms = \"x\""),
                   {":3: screen.rooms is not a known key; the nearest allowed key is screen.room"});
    expect_refused("[screen]\nroom = 5\n", {":2: screen.room is 5"});
}

TEST(ScreenRoom, MissingFileIsReported) {
    const auto missing = [](const std::string& room) {
        const auto settings =
            parse_settings("[screen]\nroom = \"" + room + "\"\n", source_dir() + "/kiosk.toml");
        EXPECT_TRUE(settings);
        return settings ? missing_files(**settings) : std::vector<std::string>();
    };
    EXPECT_EQ(missing("no.toml"),
              std::vector<std::string>{
                  "screen.room: " + source_dir() +
                  "/no.toml: there is no such file; write it (docs/room.md), or leave the line out: "
                  "then there is no screen"});
    EXPECT_EQ(missing("docs"), std::vector<std::string>{"screen.room: " + source_dir() +
                                                        "/docs: this is a folder; name a file in it"});
    EXPECT_TRUE(missing("README.md").empty());
    EXPECT_TRUE(missing_files(parsed("")).empty());
}

TEST(ScreenJson, HasCornersOnlyIfThereIsAScreen) {
    const auto json_of = [](const std::string& text) {
        const auto settings = parse_settings(text, "set/kiosk.toml");
        return nlohmann::json::parse(config_json(*settings));
    };
    EXPECT_FALSE(json_of("").contains("screen"));
    const nlohmann::json json = json_of(screen("width = 800\nconnector = \"DP-3\"")).at("screen");
    EXPECT_EQ(json.at("corners_m"),
              nlohmann::json({{-0.6, 0.7, 0.85}, {0.6, 0.7, 0.85}, {0.6, 0.7, 0.175}, {-0.6, 0.7, 0.175}}));
    EXPECT_EQ(json.at("width"), 800);
    EXPECT_EQ(json.at("height"), 1080);
    EXPECT_EQ(json.at("connector"), "DP-3");
    EXPECT_EQ(json.at("stereo"), "as_eye");
    EXPECT_EQ(json.at("room"), "set/hall/room.toml");
}

} // namespace
} // namespace frustumscreen::settings
