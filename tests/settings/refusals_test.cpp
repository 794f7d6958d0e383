#include "app/settings/language_tag.h"
#include "app/settings/missing_files.h"
#include "firmware_host/base/json.h"
#include "tests/folders.h"
#include "tests/settings/settings_text.h"

#include <set>
#include <utility>
#include <vector>

namespace frustumscreen::settings {
namespace {

TEST(Refusals, NameFileLineKeyFoundAndAllowed) {
    EXPECT_TRUE(
        test::tells(refusal("[prop]\n\n# a comment\nbase_m = -0.1\n"),
                    {"set/kiosk.toml:4: prop.base_m is -0.1", "0.02 to 2 metres", "[settings.number]"}));
    EXPECT_TRUE(test::tells(
        refusal("[eye]\ndefault_m = [0,\n 0.1,\n 1e9]\n"),
        {"set/kiosk.toml:4: eye.default_m[2] is 1000000000", "-10 to 10 metres", "[settings.number]"}));
    EXPECT_TRUE(test::tells(
        refusal("[render]\nerror_tolerance_px = 0\n"),
        {"set/kiosk.toml:2: render.error_tolerance_px is 0", "0.01 to 20 pixels", "[settings.number]"}));
}

/// Each text, and words that its refusal must contain.
using Expectations = std::vector<std::pair<std::string, std::vector<std::string>>>;

void expect_refusals(const Expectations& expectations) {
    for (const auto& [text, words] : expectations) {
        const std::string message = refusal(text);
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        for (const std::string& word : words) {
            EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' not in: " << message;
        }
    }
}

TEST(Refusals, WrongTypesAreRefused) {
    expect_refusals({
        {"[prop]\nbase_m = \"0.16\"", {":2: prop.base_m is the text \"0.16\"", "0.02 to 2 metres"}},
        {"[prop]\nbase_m = true", {":2: prop.base_m is true"}},
        {"[prop]\nbase_m = [0.16]", {":2: prop.base_m is a list of 1"}},
        {"[prop]\nbase_m = 1979-05-27", {":2: prop.base_m is a date"}},
        {"[prop]\nbase_m.x = 1", {":2: prop.base_m is a table"}},
        {"[projector]\nwidth = 1280.0", {":2: projector.width is 1280", "whole numbers 64 to 8192"}},
        {"[tracker]\nseed = -1", {":2: tracker.seed is -1", "from 0"}},
        {"[tracker]\ndisplay_latency_ms = 300",
         {":2: tracker.display_latency_ms is 300", "0 to 200 milliseconds"}},
        {"prop = 5", {":1: prop is 5; allowed is a table, [prop]"}},
        {"[[prop]]\nbase_m = 1", {"prop is a list of 1"}},
        {"[eye]\ndefault_m = [0, 1]", {":2: eye.default_m is a list of 2", "[settings.list]"}},
        {"[eye]\ndefault_m = [0, 1, \"2\"]", {":2: eye.default_m[2] is the text"}},
        {"[exhibit]\npacks = \"a.fspack\"", {":2: exhibit.packs is the text"}},
        {"[exhibit]\npacks = [\"\"]", {":2: exhibit.packs[0] is the text \"\""}},
        {"[exhibit]\nlanguage = 5", {":2: exhibit.language is 5"}},
        {"[panel]\nscript = [5]", {":2: panel.script[0] is 5"}},
    });
}

TEST(Refusals, NanAndInfinityAreRefused) {
    for (const std::string number : {"nan", "-nan", "inf", "-inf"}) {
        expect_refusals({
            {"[prop]\nbase_m = " + number, {":2: prop.base_m is "}},
            {"[eye]\ndefault_m = [0, " + number + ", 1]", {":2: eye.default_m[1] is "}},
            {"[projector]\ntable_from_projector = [1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0," + number + ",1]",
             {":2: projector.table_from_projector[14] is "}},
        });
    }
}

TEST(Refusals, UnknownKeysNameTheNearest) {
    expect_refusals({
        {"[prop]\nbase = 0.1", {":2: prop.base is not a known key; the nearest allowed key is prop.base_m"}},
        {"[projctor]\nwidth = 640",
         {":1: projctor is not a known key; the nearest allowed key is projector"}},
        {"[projector]\nthrow = 1.5", {":2: projector.throw is not", "projector.throw_ratio"}},
        {"[panel]\nscript = [{at = 1}]", {":2: panel.script[0].at is not", "panel.script[0].at_s"}},
        {"[exhibit]\nlang = \"en\"", {":2: exhibit.lang is not", "exhibit.language"}},
        {"heigth_m = 1", {":1: heigth_m is not a known key"}},
        {"[prop]\n\"new\\nline\" = 1", {":2: prop.new?line is not"}},
    });
}

TEST(Refusals, InvalidTomlIsRefused) {
    expect_refusals({
        {"[prop]\nbase_m = 0.1\nbase_m = 0.2\n", {":3: is not TOML", "base_m"}},
        {"[prop]\nbase_m = \n", {":2: is not TOML"}},
        {"[prop\n", {":1: ", "[toml.syntax]"}},
        {"[prop]\n[prop]\n", {":2: is not TOML"}},
        {"# \xff\xfe\n", {":1: is not UTF-8"}},
        {std::string("a = \"\0\"", 7), {":1: is not UTF-8"}},
    });
}

TEST(Refusals, NonRigidMatricesAreRefused) {
    const auto matrix = [](const std::string& columns) {
        return "[projector]\ntable_from_projector = " + columns;
    };
    expect_refusals({
        {matrix("[-1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,1.2,1]"),
         {":2: projector.table_from_projector", "mirrors"}},
        {matrix("[2,0,0,0, 0,-2,0,0, 0,0,-2,0, 0,0,1.2,1]"), {":2: projector.table_from_projector scales"}},
        {matrix("[1,0.1,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,1.2,1]"), {"shears"}},
        {matrix("[1,0,0,0, 0,-1,0,0, 0,0,-1,1.2, 0,0,0,1]"),
         {":2: projector.table_from_projector is written row by row; allowed is column by column"}},
        {"[tracker]\ntable_from_tracker = [0,-1,0,0.1, 1,0,0,0.2, 0,0,1,0, 0,0,0,1]",
         {":2: tracker.table_from_tracker is written row by row", "[settings.row_by_row]"}},
        // Invalid in row order and in column order.
        {matrix("[1,0,0,0.5, 0,-1,0,0, 0,0,-1,1.2, 0,0,1,1]"), {"[settings.no_rigid_transform]"}},
        {matrix("[1,0,0]"), {"is a list of 3", "16 numbers, column by column"}},
        {"[tracker]\ntable_from_tracker = [0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,0]",
         {":2: tracker.table_from_tracker"}},
    });
}

TEST(Refusals, ConflictingKeysAreRefused) {
    expect_refusals({
        {"[projector]\nfx = 1500\nthrow_ratio = 1.5", {":3: projector.throw_ratio stands beside fx"}},
        {"[projector]\nroll_deg = 0\ntable_from_projector = [1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,1.2,1]",
         {"projector.roll_deg stands beside table_from_projector"}},
        {"[prop]\nkind = \"cube\"\nheight_m = 0.2", {":3: prop.height_m is 0.2", "0.16"}},
    });
}

TEST(Refusals, UnusableValuesAreRefused) {
    expect_refusals({
        {"[prop]\ntop_m = 0.3", {":2: prop.top_m is 0.3; a frustum's top must be smaller than prop.base_m"}},
        {"[prop]\nheight_m = 1.45",
         {"projector.position_m is 1.5 metres above the table; allowed are at least 1.55"}},
        {"[prop]\nbase_m = 0.6", {":2: prop.base_m is 0.6", "at most 0.5"}},
        {"[projector]\nposition_m = [0, 0, 0.1]", {":2: projector.position_m is 0.1 metres above"}},
        {"[projector]\nposition_m = [0, 0, 1]\naim_m = [0, 0, 2]",
         {":2: projector.position_m looks -90.0 degrees"}},
        {"[projector]\nposition_m = [0, -5, 1]",
         {":2: projector.position_m throws its picture beside the table",
          "x -0.27 to 0.27 m, y -5.17 to -4.83 m, the table at x -0.40 to 0.40 m, y -0.25 to 0.25 m"}},
        {"[projector]\ncx = -1280", {"[settings.picture_beside_table]", "x 0.53 to 1.33 m", "lens shift"}},
        {"[projector]\ntable_from_projector = [1,0,0,0, 0,-1,0,0, 0,0,-1,0, 2,0,1.2,1]",
         {":2: projector.table_from_projector throws its picture beside the table"}},
        {"[projector]\nposition_m = [0.7, 0, 1.5]",
         {":2: projector.position_m throws its picture so that the prop, 0.3 m wide, cannot stand in it "
          "anywhere"}},
        {"[projector]\nposition_m = [0, 0, 1]\naim_m = [0, 0, 1]",
         {":3: projector.aim_m gives no direction"}},
        {"[projector]\nposition_m = [0, 0, 1]\naim_m = [0, 5, 1]",
         {":3: projector.aim_m gives no direction"}},
        {"[projector]\ntable_from_projector = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1.2,1]",
         {":2: projector.table_from_projector looks -90.0 degrees below"}},
        {"[eye]\ndefault_m = [0, 0, 0.05]", {":2: eye.default_m lies inside the prop"}},
        {"[eye]\ndefault_m = [0, -1, -0.5]", {":2: eye.default_m is -0.5 metres above the table"}},
        {"[eye]\nnearest_m = 3", {":2: eye.nearest_m is 3; allowed are distances below eye.farthest_m, 2"}},
        {"[tracker]\nkind = \"replay\"", {":2: tracker.kind is \"replay\"; it needs tracker.poses"}},
        {"[tracker]\nkind = \"magic\"",
         {":2: tracker.kind is the text \"magic\"", "\"simulated\", \"replay\""}},
        {"[tracker]\nhemisphere = [0, 0, 0]", {":2: tracker.hemisphere gives no direction"}},
        {"[eye]\ntracked = 1", {":2: eye.tracked is", "allowed are true and false"}},
        {"[display]\nforce = true", {":2: display.force is true", "display.mode"}},
        {"[display]\nmode = \"1280*800\"", {":2: display.mode is the text", "1280x800@60"}},
        {"[display]\nmode = \"1280x800@6\"", {":2: display.mode is the text", "10 to 480 hertz"}},
        {"[display]\nmode = \"1280x800@60 \"", {":2: display.mode is the text"}},
        {"[display]\nmode = \"32x32\"", {":2: display.mode is the text", "64 to 8192"}},
        {"[display]\nkind = \"x11\"", {":2: display.kind is", "kms"}},
        {"[display]\nscreen = 1", {":2: display.screen is not"}},
        {"[panel]\nkind = \"gpio\"", {":2: panel.kind is \"gpio\"", "panel.lines"}},
        {"[panel]\nkind = \"keys\"", {":2: panel.kind is \"keys\"", "panel.device", "panel.keys"}},
        {"[panel]\nlamps = [\"1\"]", {":2: panel.lamps names 1 lamps", "each of the 0 lines"}},
        {"[panel]\nlines = [\"3\", \"3\", \"3\"]",
         {":2: panel.lines names \"3\" again", "a line of its own"}},
        {"[panel]\nlines = [\"red\", \"4\", \"red\"]", {":2: panel.lines names \"red\" again"}},
        {"[panel]\nlines = [\"0\", \"1\", \"00\"]", {":2: panel.lines names \"00\" again"}},
        {"[panel]\nlines = [\"3\", \"4\"]\nlamps = [\"5\", \"3\"]",
         {":3: panel.lamps names \"3\" again", "not in panel.lines"}},
        {"[panel]\nlines = [\"3\", \"4\"]\nlamps = [\"5\", \"5\"]", {":3: panel.lamps names \"5\" again"}},
        {"[panel]\nkeys = [\"KEY_L\", \"KEY_R\", \"KEY_L\"]",
         {":2: panel.keys names \"KEY_L\" again", "a key of its own"}},
        {"[panel]\nscript = [{at_s = 2}, {at_s = 1}]", {":2: panel.script goes back in time"}},
        {"[sound]\nhours = [{from_h = 9}, {from_h = 8}]", {":2: sound.hours goes back in time"}},
        {"[sound]\nhours = [{from_h = 9}, {from_h = 9}]", {":2: sound.hours", "[settings.sound_hours]"}},
        {"[camera]\nexposure_ms = 40.0",
         {":2: camera.exposure_ms is 40", "at camera.rate_hz, 30 hertz, takes 33.3 milliseconds"}},
        {"[camera]\nrolling_shutter_ms = 40.0",
         {":2: camera.rolling_shutter_ms is 40", "at camera.rate_hz, 30 hertz, takes 33.3 milliseconds"}},
        {"[camera]\nwhite_balance_k = 500",
         {":2: camera.white_balance_k is 500", "0 (the camera's own) and 2000 to 10000 kelvin"}},
        {"[camera]\ndrift = true", {":2: camera.drift is true; it needs camera.kind = \"v4l2\""}},
        {"[camera]\ntags = true", {":2: camera.tags is true; it needs camera.kind = \"v4l2\""}},
        {"[camera]\nkind = \"v4l2\"\ntags = true", {":3: camera.tags is true; it needs camera.fx"}},
        {"[camera]\nkind = \"v4l2\"\ntags = true\nfx = 1500",
         {":3: camera.tags is true; it needs camera.table_from_camera"}},
        {"[camera]\nkind = \"v4l2\"\ntags = true\nfx = 1500\ntable_from_camera = "
         "[1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 1.3, 1]",
         {":3: camera.tags is true; it needs [[camera.tag]]"}},
        {"[camera]\nkind = \"v4l2\"\ntags = true\nfx = 1500\ntable_from_camera = "
         "[1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 1.3, 1]\n[[camera.tag]]\nid = 3\n[[camera.tag]]\nid = "
         "3",
         {"camera.tag has the id 3 twice"}},
        {"[camera]\n[[camera.tag]]\nid = 587", {":3: camera.tag", "id", "0 to 586"}},
        {"[camera]\nfx = 100\nk1 = -0.5\nkind = \"v4l2\"\ntags = true\ntable_from_camera = "
         "[1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 1.3, 1]\n[[camera.tag]]\nid = 3",
         {":3: camera.k1", "[settings.lens_folds]"}},
        {"[projector]\nwidth = 1921\n[eye]\nstereo = \"side_by_side\"",
         {":4: eye.stereo is \"side_by_side\", and projector.width is 1921", "even width",
          "[settings.stereo_odd_width]"}},
        {"[projector]\nheight = 1081\nstereo = \"top_bottom\"",
         {":3: projector.stereo is \"top_bottom\", and projector.height is 1081", "even height",
          "[settings.stereo_odd_height]"}},
        {"[eye]\nstereo = \"on\"", {":2: eye.stereo", "\"anaglyph\""}},
        {"[tracker]\nright_in_sensor = [0, 0, 0]",
         {":2: tracker.right_in_sensor gives no direction", "[settings.right_in_sensor]"}},
        {"[camera]\nvisitor = true", {":2: camera.visitor is true; it needs camera.kind = \"v4l2\""}},
        {"[camera]\nkind = \"v4l2\"\nvisitor = true", {":3: camera.visitor is true; it needs camera.fx"}},
        {"[camera]\nkind = \"v4l2\"\nvisitor = true\nfx = 293\ntable_from_camera = "
         "[1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 1.3, 1]", // straight down
         {":3: camera.visitor is true; it needs camera.table_from_camera", "[settings.camera_not_upright]"}},
        {"[camera]\nkind = \"v4l2\"\nvisitor = true\nfx = 293\ntable_from_camera = "
         "[-1, 0, 0, 0, 0, 0, -1, 0, 0, -1, 0, 0, 0, 0.28, 0.12, 1]\n[eye]\ntracked = false",
         {":3: camera.visitor is true; eye.tracked is false"}},
        {"[camera]\nkind = \"usb\"", {":2: camera.kind", "\"none\"", "\"v4l2\""}},
        {"[panel]\nscript = [{at_s = 2}]\nrepeat_s = 2",
         {":3: panel.repeat_s is 2", "after the last press, 2"}},
        {"[panel]\nscript = [{at_s = 0}]\nrepeat_s = 1e-6",
         {":3: panel.repeat_s is 1e-06", "at least 0.05 seconds"}},
        {"[exhibit]\nlanguage = \"e\"", {":2: exhibit.language", "\"de-CH\""}},
        {"[exhibit]\nlanguage = \"../etc\"", {":2: exhibit.language"}},
    });
}

TEST(Refusals, InvalidLanguageTagsAreRefused) {
    for (const std::string tag : {"xx", "english", "en_GB", "de-", "-de", "de--CH", "d", "", "e n", "1a",
                                  "dé", "de-farmhouses", "germ"}) {
        const std::string message = refusal("[exhibit]\nlanguage = \"" + tag + "\"");
        EXPECT_NE(message.find(":2: exhibit.language is the text \"" + tag + "\"; allowed "),
                  std::string::npos)
            << tag << ": " << message;
    }
    for (const std::string tag :
         {"en", "EL", "de-CH", "zh-Hant-TW", "gsw", "es-419", "sl-rozaj-biske", "de-CH-1996"}) {
        EXPECT_EQ(refusal("[exhibit]\nlanguage = \"" + tag + "\""), "") << tag;
    }
}

/// Debian's own list, if it is installed, has the same two-letter codes.
TEST(Refusals, LanguageCodesMatchIso639) {
    std::ifstream file("/usr/share/iso-codes/json/iso_639-3.json");
    const nlohmann::json codes = nlohmann::json::parse(file, nullptr, false);
    if (codes.is_discarded()) {
        GTEST_SKIP() << "the package iso-codes is not installed";
    }
    std::set<std::string> known;
    for (const nlohmann::json& language : codes.at("639-3")) {
        known.insert(language.value("alpha_2", ""));
    }
    ASSERT_GT(known.size(), 150U);
    for (char first = 'a'; first <= 'z'; ++first) {
        for (char second = 'a'; second <= 'z'; ++second) {
            const std::string code{first, second};
            EXPECT_EQ(parse_language_tag(code).has_value(), known.count(code) == 1) << code;
        }
    }
}

/// Only `missing_files` looks for files: settings are valid without them.
TEST(MissingFiles, AreReportedWithTheLineThatNamesThem) {
    const auto settings = parse_settings("[tracker]\nkind = \"replay\"\nposes = \"visit.csv\"\n[exhibit]\n"
                                         "packs = [\n\"cat.fspack\", \"README.md\", \"docs\"]\n",
                                         source_dir() + "/kiosk.toml");
    ASSERT_TRUE(settings) << settings.error().message;
    const std::string& folder = source_dir();
    EXPECT_EQ(
        missing_files(**settings),
        (std::vector<std::string>{
            folder + "/kiosk.toml:5: exhibit.packs: " + folder +
                "/cat.fspack: there is no such file; make it with frustumscreen-bake, or take it off the "
                "list",
            folder + "/kiosk.toml:5: exhibit.packs: " + folder + "/docs: this is a folder; name a file in it",
            folder + "/kiosk.toml:3: tracker.poses: " + folder +
                "/visit.csv: there is no such file; make it with frustumscreen record, or choose another "
                "tracker.kind"}));
    EXPECT_TRUE(missing_files(parsed("[tracker]\nkind = \"usb\"\nposes = \"visit.csv\"\n")).empty());
}

TEST(Refusals, SimilarPanelLinesAreAccepted) {
    EXPECT_EQ(refusal("[panel]\nlines = [\"3\", \"30\", \"GPIO3\"]\nlamps = [\"0\", \"03a\", \"3a\"]\n"
                      "keys = [\"KEY_3\", \"KEY_03\"]"),
              "");
}

TEST(Refusals, TooLargeAndMissingFilesAreRefused) {
    const std::string message = refusal(std::string((std::size_t{1} << 20) + 1, '#'));
    EXPECT_NE(message.find("1048577 bytes"), std::string::npos) << message;
    const auto missing = load_settings("no/such/kiosk.toml");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().kind, ErrorKind::BadConfiguration);
    EXPECT_NE(missing.error().message.find("no/such/kiosk.toml"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::settings
