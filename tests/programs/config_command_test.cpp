// `frustumscreen config` from outside: the page in words, the JSON, and the messages about missing files.

#include "firmware_host/base/json.h"
#include "tests/programs/program_folder.h"

#include <cmath>

namespace frustumscreen::programs {
namespace {

constexpr const char* lens = "[projector]\nwidth = 1280\nheight = 800\nthrow_ratio = 1.5\n";
constexpr const char* steep_prop = "[prop]\nbase_m = 0.16\ntop_m = 0.09\nheight_m = 0.12\n";

class ConfigCommand : public ProgramFolder {
protected:
    /// The page for these settings.
    [[nodiscard]] std::string page(const std::string& settings) const {
        put("kiosk.toml", settings);
        EXPECT_EQ(run("frustumscreen config --config kiosk.toml --explain"), 0) << text("err.txt");
        return text("out.txt");
    }
    void expect_words(const std::string& said, const std::vector<std::string>& words) const {
        for (const std::string& each : words) {
            EXPECT_NE(said.find(each), std::string::npos) << each << "\nis not in:\n" << said;
        }
    }
};

TEST_F(ConfigCommand, ExplainsAProjectorThatLooksStraightDown) {
    // 1.2 m over 1920 pixels; the top is 0.12 m nearer. A side's centre is 0.0625 m off the axis and 0.06 m high, and
    // its normal is (0.96, 0.28): its light is h / d^3 with h = 1.14 * 0.28 - 0.0625 * 0.96.
    const double side = (1.14 * 0.28 - 0.0625 * 0.96) / std::pow(std::hypot(0.0625, 1.14), 3);
    const double top = 1.0 / (1.08 * 1.08);
    expect_words(
        page(std::string(lens) + "position_m = [0, 0, 1.2]\n" + steep_prop),
        {"1.200 m above the table", "0.0 degrees away from straight down", "1280 x 800 pixels at 60 Hz",
         "top left corner is at x -0.400, y 0.250 m", "bottom right corner is at x 0.400, y -0.250 m",
         "covers 100 % of the table of 0.8 x 0.5 m", "One projector pixel is 0.625 mm on the table",
         "letters are 16 pixels high", "+Z: one pixel is 0.563 mm; the light is 1.00 of",
         fmt::format("+X, -X, +Y, -Y: one pixel is 0.594 x 2.61 mm; the light is {:.2f} of", side / top),
         fmt::format("Faces are lit 1 : {:.2f}.", side / top), "evenly lit nowhere: its sides are too steep",
         "1.08 to 1.20 m in front of the lens", "A tracker error of 1 mm: 1.8 pixels",
         "moves 5.1 mm meanwhile"});
    EXPECT_EQ(text("err.txt"), "");
}

TEST_F(ConfigCommand, SaysHowEvenlyTheShippedTableIsLit) {
    // At every yaw half a base's diagonal stays on the table: 0.25 - 0.15 sqrt(2) m, and nearly 0.4 - 0.15 sqrt(2) m.
    expect_words(page(""),
                 {"1920 x 1200 pixels", "evenly lit within x -0.186 to 0.186 m, y -0.038 to 0.038 m",
                  "Faces are lit 1 : 0.36 at the worst turn"});
}

TEST_F(ConfigCommand, SaysWhereCaptionsAreTooSmallOrTooDark) {
    const std::string straight_down = std::string(lens) + "position_m = [0, 0, 1.2]\n" + steep_prop;
    // 24 pt are a third of an inch, and a pixel is 0.625 mm. The text has 0.8 * 0.3 of white, and black is assumed as
    // 0.05.
    const std::string small_and_dark =
        page(straight_down + "[exhibit]\ncaption_height_m = 0.003\ncaption_brightness = 0.3\n");
    expect_words(small_and_dark,
                 {fmt::format("letters are {:.0f} pixels high", 25.4 / 3.0 / 0.625),
                  "caption_height_m, 3 mm, is less than 24 pt: captions are set at 24 pt, 8.47 mm",
                  "a contrast of 5.8:1 with the table, and needs 7:1, from 0.375 on"});
    for (const char* well : {"", "caption_height_m = 0.0085\ncaption_brightness = 0.38\n",
                             "captions = false\ncaption_height_m = 0.003\ncaption_brightness = 0.3\n"}) {
        const std::string said = page(straight_down + "[exhibit]\n" + well);
        EXPECT_EQ(said.find("24 pt"), std::string::npos) << said;
        EXPECT_EQ(said.find("contrast"), std::string::npos) << said;
    }
}

TEST_F(ConfigCommand, ExplainsAProjectorThatLooksFromTheFarSide) {
    // The point on the axis is hypot(0.9, 1) m away, tilted by atan(0.9): a pixel is that / 1920 across, and longer
    // along the table.
    const double across_mm = 1e3 * std::hypot(0.9, 1.0) / 1920.0;
    expect_words(page(std::string(lens) + "position_m = [0, 0.9, 1]\naim_m = [0, 0, 0]\n" + steep_prop),
                 {fmt::format("looks {:.1f} degrees away", 180.0 / M_PI * std::atan(0.9)),
                  fmt::format("One projector pixel is {:.3g} x {:.3g} mm on the table", across_mm,
                              across_mm * std::hypot(0.9, 1.0)),
                  "-Y: no light.", "Nowhere for eyes all around: hang the projector higher"});
}

TEST_F(ConfigCommand, ExplainsACubeInTheHand) {
    const std::string said =
        page(std::string(lens) + "position_m = [0, 0, 1.2]\n[prop]\nkind = \"cube\"\nbase_m = 0.1\n");
    // In any orientation, its corners are 0.0866 m from its middle, which is at that height. There the picture, which
    // is 0.4 x 0.25 m to each side on the table, is smaller by 0.0866 / 1.2, and the ball reduces it further.
    expect_words(said, {"+X, -X, +Y, -Y, -Z: no light.", "At every turn while its middle is within x -0.2"});
    EXPECT_EQ(said.find("evenly"), std::string::npos);
}

TEST_F(ConfigCommand, ReportsTheSharpDepthOfTheHandsZone) {
    const std::string hand =
        std::string(lens) +
        "position_m = [0, 0, 1.2]\naperture_mm = {}\n[prop]\nkind = \"cube\"\nbase_m = 0.1\n";
    // The picture's half height is 400 pixels at 1920 pixels of focal length. A ball of 0.1 sqrt(3) / 2 m touches it
    // above and below at this distance:
    const double ball = 0.05 * std::sqrt(3.0);
    const double near = ball / std::sin(std::atan(400.0 / 1920.0)) - ball;
    const double focus = 0.5 * (near + 1.2);
    // A (1 - near / focus) is the circle there, and near / 1920 a pixel.
    const double blur = 0.010 * (1.0 - near / focus) / (near / 1920.0);
    expect_words(page(fmt::format(fmt::runtime(hand), 10)),
                 {fmt::format("Focused at {:.3f} m", focus),
                  fmt::format("Not all of the zone of the hand, {:.3f} to 1.200 m, is sharp", near),
                  fmt::format("the blur is {:.1f} pixels", blur),
                  fmt::format("aperture of {:.2g} mm", 10.0 / blur)});
    expect_words(page(fmt::format(fmt::runtime(hand), 0.2)),
                 {"All of the zone of the hand", "m on in front"});
}

TEST_F(ConfigCommand, SaysWhichFilesAreMissingAndPrintsTheSettings) {
    ASSERT_TRUE(
        write_file(folder / "kiosk.toml",
                   as_bytes("[tracker]\nkind = \"replay\"\nposes = \"visit.csv\"\n[exhibit]\npacks = [\n"
                            "\"cat.fspack\", \"kiosk.toml\"]\n")));
    ASSERT_EQ(run("frustumscreen config --config kiosk.toml --json"), 0);
    EXPECT_EQ(text("err.txt"),
              "frustumscreen: kiosk.toml:5: exhibit.packs: cat.fspack: there is no such file; make it with "
              "frustumscreen-bake, or take it off the list\n"
              "frustumscreen: kiosk.toml:3: tracker.poses: visit.csv: there is no such file; make it with "
              "frustumscreen "
              "record, or choose another tracker.kind\n");
    EXPECT_EQ(nlohmann::json::parse(text("out.txt"), nullptr, false).at("exhibit").at("packs").size(), 2U);
}

TEST_F(ConfigCommand, RefusesWrongUseAndInvalidSettings) {
    put("kiosk.toml", "[projector]\ncx = -1280\n");
    EXPECT_EQ(run("frustumscreen config --config kiosk.toml --explain"), 1);
    expect_words(text("err.txt"),
                 {"frustumscreen: kiosk.toml: projector.position_m throws its picture beside the table"});
    EXPECT_EQ(text("out.txt"), "");
    for (const char* options :
         {"", "--explain", "--config kiosk.toml --explain --json", "--describe --explain"}) {
        EXPECT_EQ(run(fmt::format("frustumscreen config {}", options)), 2) << options;
    }
    EXPECT_EQ(run("frustumscreen config --describe"), 0);
}

TEST_F(ConfigCommand, ReportsNoProblemsForTheDefaultSetUp) {
    const std::string said = page("");
    expect_words(said, {"seen whole from all around while the prop is within 44 x 15 cm",
                        "10 mm high, 24 pixels", "a capital is 22 minutes of arc high",
                        "awake all day, every day", "To check\n  Nothing.\n"});
}

TEST_F(ConfigCommand, JudgesLettersThatAreTooFewPixelsOrTooSmall) {
    // 1.5 m divided by a focal length of 100 / 0.8 x 1.5 pixels.
    expect_words(
        page("[projector]\nwidth = 100\nheight = 100\nthrow_ratio = 1.875\n"),
        {"letters are 1 pixels high, too few to read: they need 18", "exhibit.caption_height_m = 0.144"});
    // A capital is 0.714 of the type's height, seen from 1.9 m away and 0.5 m above the table.
    const double arcmin = 60.0 * 180.0 / M_PI * 0.01 * 0.714 * 0.5 / (1.8 * 1.8 + 0.5 * 0.5);
    expect_words(page("[eye]\ndefault_m = [0, -1.8, 0.5]\n"),
                 {fmt::format("a capital is {:.0f} minutes of arc high, and needs 16", arcmin)});
}

/// Straight down through a cube, the two eyes converge by 2 atan(b / 2r) on its top and on its bottom; no other ray has much more.
TEST_F(ConfigCommand, JudgesTheParallaxOfStereo) {
    const std::string cube = "[prop]\nkind = \"cube\"\nbase_m = 0.02\nzone = \"table\"\n[eye]\n";
    const auto degrees = [](double b, double r) { return 2.0 * 180.0 / M_PI * std::atan(0.5 * b / r); };
    const std::string near = page(cube + "nearest_m = 0.4\nstereo = \"anaglyph\"\n");
    EXPECT_EQ(near.find("tires"), std::string::npos) << near;
    const std::string::size_type said = near.find("a parallax of up to ");
    ASSERT_NE(said, std::string::npos) << near;
    const double parallax = std::atof(near.c_str() + said + 20);
    EXPECT_GT(parallax, degrees(0.063, 0.38) - degrees(0.063, 0.4));
    EXPECT_LT(parallax, degrees(0.063, 0.4 - 0.02 * std::sqrt(3.0)) - degrees(0.063, 0.4));
    expect_words(page("[eye]\nstereo = \"side_by_side\"\n"),
                 {"In stereo (side_by_side)", "eyes 0.35 m from the prop (eye.nearest_m)",
                  "Stereo tires eyes near the prop", "comfortable is 1 degree", "eye.interocular_mm = "});
    expect_words(page("[eye]\nstereo = \"frame_sequential\"\n"),
                 {"Frame-sequential stereo flickers: each eye sees 30 pictures a second, and needs 50"});
    EXPECT_EQ(page("").find("tereo"), std::string::npos);
}

TEST_F(ConfigCommand, JudgesAZoneThatIsTooNarrow) {
    expect_words(page("[projector]\nwidth = 1920\nheight = 1000\nthrow_ratio = 2.0\n"),
                 {"The zone is too narrow to play in", "With a throw ratio of"});
}

TEST_F(ConfigCommand, SaysThisWeeksHours) {
    const std::string said = page("[hours]\nmonday = []\ntuesday = [\"9:00-18:00\"]\ntime_zone = \"UTC\"\n");
    expect_words(said,
                 {"This week, by this machine's clock", "closed.", "09:00-18:00.", "all day.", "It is "});
    for (const char* day : {"Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday"}) {
        EXPECT_NE(said.find(fmt::format("\n  {:<9} 20", day)), std::string::npos) << day;
    }
}

} // namespace
} // namespace frustumscreen::programs
