// The contents of artifact.toml, and the messages about mistakes in it.
#include "assets_baked/folder/artifact_file.h"
#include "tests/base/told.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

using namespace frustumscreen;
using namespace frustumscreen::folder;

namespace {

constexpr std::string_view whole = R"(
scan = "vase.glb"
texture = "pictures/skin.png"
id = "vase-1"
licence = "CC0-1.0"
size = 256
unlit = true
prop = "cube"
[placement]
up = "-z"
turn_deg = -30
scale = 1.5
lift = 0.25
[[texts]]
language = "el"
title = "Αγγείο"
period = "540 π.Χ."
place = "Αθήνα"
maker = "άγνωστος"
credit = "Δωρεά"
text = """
Πρώτη γραμμή.
Δεύτερη."""
description = ""
[[texts]]
language = "en"
description = "A vase."
recording = "speech/en.flac"
[[hotspots]]
point = [1, -2.5, 3e2]
labels = { en = "The handle", el = "Η λαβή" }
)";

std::string refusal(const std::string& text) {
    const Result<ArtifactFile> file = parse_artifact_file(text, "vase/artifact.toml");
    return file ? std::string() : test::told(file.error());
}

} // namespace

TEST(ArtifactFile, parses_every_key) {
    const Result<ArtifactFile> read = parse_artifact_file(whole, "vase/artifact.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->scan, "vase/vase.glb");
    EXPECT_EQ(read->texture, "vase/pictures/skin.png");
    EXPECT_EQ(read->id, "vase-1");
    EXPECT_EQ(read->licence, "CC0-1.0");
    EXPECT_EQ(read->recordings,
              (std::map<std::string, std::filesystem::path>{{"en", "vase/speech/en.flac"}}));
    EXPECT_EQ(read->size, 256);
    EXPECT_TRUE(read->unlit);
    EXPECT_EQ(read->prop, "cube");
    EXPECT_EQ(read->up, "-z");
    EXPECT_EQ(read->turn_deg, -30.0);
    EXPECT_EQ(read->scale, 1.5);
    EXPECT_EQ(read->lift, 0.25);
    ASSERT_EQ(read->texts.size(), 2U);
    EXPECT_TRUE(read->texts[0] == (pack::PackCaption{"el", "Αγγείο", "Πρώτη γραμμή.\nΔεύτερη.", "540 π.Χ.",
                                                     "Αθήνα", "άγνωστος", "Δωρεά", ""}));
    EXPECT_EQ(read->texts[1].title, "Αγγείο") << "the first one's, where it is left out";
    ASSERT_EQ(read->hotspots.size(), 1U);
    EXPECT_EQ(read->hotspots[0].point_file, glm::dvec3(1, -2.5, 300));
    EXPECT_EQ(read->hotspots[0].labels,
              (std::vector<pack::PackLabel>{{"el", "Η λαβή"}, {"en", "The handle"}}));
    EXPECT_EQ(read->hotspots[0].place, "vase/artifact.toml:30: hotspots[0].point");
}

TEST(ArtifactFile, requires_only_a_scan) {
    const Result<ArtifactFile> read = parse_artifact_file("scan = 'a.stl'", "artifact.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->scan, "a.stl");
    EXPECT_TRUE(read->up.empty());
    EXPECT_FALSE(read->turn_deg);
    EXPECT_EQ(read->size, 512);
    EXPECT_EQ(read->prop, "frustum");
    EXPECT_TRUE(test::tells(refusal("unlit = true"), {"vase/artifact.toml: scan ", "[folder.no_scan]"}));
}

TEST(ArtifactFile, suggests_the_key_scan_for_a_misspelt_one) {
    EXPECT_TRUE(test::tells(refusal("\nscna = \"a.stl\"\n"),
                            {"vase/artifact.toml:2: scna ", "key is scan ", "[settings.unknown_key]"}));
}

TEST(ArtifactFile, trims_blanks_from_texts) {
    const Result<ArtifactFile> read =
        parse_artifact_file("scan = 'a.stl'\n[[texts]]\nlanguage = 'en'\ntitle = '  '\n"
                            "text = \"\"\"\n\n A jug. \u3000\n\"\"\"\n"
                            "description = \" \u00a0 \"",
                            "artifact.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->texts[0].title, "");
    EXPECT_EQ(read->texts[0].text, "A jug.");
    EXPECT_EQ(read->texts[0].description, "");
}

TEST(ArtifactFile, matches_languages_in_any_case) {
    const Result<ArtifactFile> read =
        parse_artifact_file("scan = 'a.stl'\n[[texts]]\nlanguage = 'EN'\n[[texts]]\nlanguage = 'zh-HANT-tw'\n"
                            "description = 'x'\nrecording = 'a.wav'\n"
                            "[[hotspots]]\npoint = [0, 0, 0]\nlabels = { eN = 'x', ZH-hant-TW = 'y' }",
                            "artifact.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->texts[0].language, "en");
    EXPECT_EQ(read->texts[1].language, "zh-Hant-TW");
    EXPECT_TRUE(read->recordings.contains("zh-Hant-TW"));
    EXPECT_EQ(read->hotspots[0].labels, (std::vector<pack::PackLabel>{{"zh-Hant-TW", "y"}, {"en", "x"}}));
}

TEST(ArtifactFile, accepts_an_empty_table_of_a_site) {
    EXPECT_FALSE(parse_artifact_file("scan = 'a.stl'", "artifact.toml")->site);
    EXPECT_EQ(parse_artifact_file("scan = 'a.stl'\n[site]", "artifact.toml")->site->max_triangles, 150'000);
    EXPECT_EQ(parse_artifact_file("scan = 'a.stl'\n[site]\nmax_triangles = 2000", "artifact.toml")
                  ->site->max_triangles,
              2000);
}

TEST(ArtifactFile, reports_mistakes_with_line_and_remedy) {
    const std::string scan = "scan = \"a.stl\"\n";
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"license = \"CC0\"", ":2: license is not a known key; the nearest allowed key is licence"},
        {"[placment]\nup = \"z\"", ":2: placment is not a known key; the nearest allowed key is placement"},
        {"[placement]\nturn = 5",
         ":3: placement.turn is not a known key; the nearest allowed key is placement.turn_deg"},
        {"[[texts]]\nlanguage = \"en\"\ntitel = \"x\"",
         ":4: texts[0].titel is not a known key; the nearest allowed key is texts[0].title"},
        {"[[hotspots]]\npoint = [0, 0, 0]\nlabel = { en = \"x\" }",
         ":4: hotspots[0].label is not a known key; the nearest allowed key is hotspots[0].labels"},
        {"[[hotspots]]\npiont = [0, 0, 0]\nlabels = { en = \"x\" }",
         ":3: hotspots[0].piont is not a known key; the nearest allowed key is hotspots[0].point"},
        {"[[hotspots]]\npoint = [0, 0, 0]\nlabels = {}", "hotspots[0].labels has no text"},
        {"[[texts]]\nlangauge = \"en\"",
         ":3: texts[0].langauge is not a known key; the nearest allowed key is texts[0].language"},
        {"[[text]]\nlanguage = \"en\"", ":2: [[text]] is not known; the nearest one is [[texts]]"},
        {"[[hotpsots]]\npoint = [0, 0, 0]", ":2: [[hotpsots]] is not known; the nearest one is [[hotspots]]"},
        {"[placement]\nup = \"up\"", ":3: placement.up is the text \"up\"; allowed are \"x\""},
        {"size = 5", ":2: size is 5; allowed are the whole numbers 16 to 4096"},
        {"[placement]\nscale = nan", ":3: placement.scale is nan; allowed are 0.05 to 20"},
        {"[placement]\nlift = inf", ":3: placement.lift is inf"},
        {"prop = \"sphere\"", ":2: prop is the text \"sphere\"; allowed are \"frustum\", \"cube\""},
        {"id = \"Vase 1\"", ":2: id is \"Vase 1\"; allowed are 1 to 64 of a-z"},
        {"[[texts]]\ntitle = \"x\"", ":2: texts[0].language is missing"},
        {"[[texts]]\nlanguage = \"english\"",
         ":3: texts[0].language is for \"english\"; allowed are language tags"},
        {"[[texts]]\nlanguage = \"en\"\n[[texts]]\nlanguage = \"en\"",
         ":5: texts[1].language is \"en\" a second time"},
        {"[[texts]]\nlanguage = \"en\"\ntitle = 5", ":4: texts[0].title is 5; allowed is a text in quotes"},
        {"[[texts]]\nlanguage = \"en\"\ntitle = \"a\\u001b\"",
         ":4: texts[0].title has the control character U+001B"},
        {"[[texts]]\nlanguage = \"en\"\ntitle = \"a\\u202Eb\"", ":4: texts[0].title has U+202E"},
        {"[[texts]]\nlanguage = \"en\"\ntitle = \"" + std::string(1001, 'x') + "\"", "has 1001 bytes"},
        {"[[texts]]\nlanguage = \"en\"\ntext = \"" + std::string(4 << 20, 'x') + "\"", "has 4194304 bytes"},
        {"[[texts]]\nlanguage = \"en\"\ntext = \"\"\"" + std::string(10000, '\n') + "\"\"\"",
         "more than 1000 lines"},
        {"[[hotspots]]\nlabels = { en = \"x\" }", ":2: hotspots[0].point is missing"},
        {"[[hotspots]]\npoint = [0, 0]\nlabels = { en = \"x\" }", ":3: hotspots[0].point is a list of 2"},
        {"[[hotspots]]\npoint = [0, nan, 0]\nlabels = { en = \"x\" }", ":3: hotspots[0].point[1] is nan"},
        {"[[hotspots]]\npoint = [0, 0, 0]\nlabels = \"x\"", ":4: hotspots[0].labels is the text \"x\""},
        {"[[hotspots]]\npoint = [0, 0, 0]\nlabels = { en = 5 }", ":4: hotspots[0].labels.en is 5"},
        {"[[hotspots]]\npoint = [0, 0, 0]\nlabels = { xx = \"x\" }", ":4: hotspots[0].labels is for \"xx\""},
        {"[[hotspots]]\npoint = [0, 0, 0]\nlabels = { en = \"\" }", ":4: hotspots[0].labels in en is empty"},
        {"[[hotspots]]\npoint = [0, 0, 0]\nlabels = { en = \" \u00a0\" }",
         ":4: hotspots[0].labels in en is empty"},
        {"[[texts]]\nlanguage = \"en\"\n[[texts]]\nlanguage = \"EN\"",
         ":5: texts[1].language is \"en\" a second time"},
        {"[[hotspots]]\npoint = [0, 0, 0]\nlabels = { en = \"x\", EN = \"y\" }",
         ":4: hotspots[0].labels has \"en\" twice"},
        {"texture = \"/etc/passwd\"",
         ":2: texture is \"/etc/passwd\"; allowed is the name of a file in this folder"},
        {"texture = \"a/../../b\"", ":2: texture is \"a/../../b\""},
        {"[[texts]]\nlanguage = \"en\"\ndescription = \"x\"\nrecording = \"../a.wav\"",
         ":5: texts[0].recording is \"../a.wav\"; allowed is the name of a file in this folder"},
        {"[[texts]]\nlanguage = \"en\"\nrecording = \"a.wav\"",
         ":4: texts[0].recording has no description beside it"},
        {"hotspots = 5", ":2: hotspots is 5"},
        {"[[texts]]\nlanguage = \"en\"\ntext = \"not closed", "is not TOML"},
        {"title = Jug", "[toml.syntax]"},
        {"[texts]\nlanguage = \"en\"",
         ":2: [texts] has one bracket too few on each side; write [[texts]], once for each language"},
        {"[hotspots]\npoint = [0, 0, 0]", ":2: [hotspots] has one bracket too few"},
        {"title = \"Jug\"", ":2: title belongs below a line [[texts]]"},
        {"titel = \"Jug\"",
         ":2: titel is not a known key; the nearest one, title, belongs below a line [[texts]]"},
        {"[sites]", ":2: sites is not a known key; the nearest allowed key is site"},
        {"[site]\nmax_triangle = 9",
         ":3: site.max_triangle is not a known key; the nearest allowed key is site.max_triangles"},
        {"[site]\nmax_triangles = 9", ":3: site.max_triangles is 9"},
        {"max_triangles = 2000", ":2: max_triangles belongs below a line [site]"},
        {"[site]\n[[behaviours]]\nname = \"open\"\nanimation = \"Lid\"",
         ":2: site stands beside [[behaviours]]"},
        {"turn_deg = 3\ntitle = \"Jug\"", ":2: turn_deg belongs below a line [placement]"},
        {"labels = { en = \"x\" }", ":2: labels belongs below a line [[hotspots]]"},
        {"# caf\xE9", ":2: is not UTF-8; save the file as UTF-8"},
        {"title = \"\xED\xA0\x80\"", ":2: is not UTF-8; save the file as UTF-8"},
        {std::string("s\0c\0", 4), ":2: is not UTF-8; save the file as UTF-8"}};
    for (const auto& [text, words] : wrong) {
        const std::string message = refusal(scan + text);
        EXPECT_EQ(message.find("vase/artifact.toml:"), 0U) << message;
        EXPECT_NE(message.find(words), std::string::npos) << words << "\n" << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_LT(message.size(), 400U) << message;
    }
    std::string four;
    for (int k = 0; k < 4; ++k) {
        four += "[[hotspots]]\npoint = [0, 0, 0]\nlabels = { en = \"x\" }\n";
    }
    EXPECT_NE(refusal(scan + four).find("at most 3 tables"), std::string::npos) << refusal(scan + four);
}

TEST(ArtifactFile, limits_dots_in_keys_but_not_in_texts) {
    std::string sentences;
    for (int k = 0; k < 900; ++k) {
        sentences += "... A \\\" and a # and \u2026 more ...... dots.\n";
    }
    EXPECT_EQ(refusal("scan = \"a.stl\" # v1.0\n[[texts]]\nlanguage = \"en\"\ntext = \"\"\"" + sentences +
                      "\"\"\"\n"),
              "");
    std::string deep = "a";
    for (int k = 0; k < 6000; ++k) {
        deep += ".a";
    }
    EXPECT_NE(refusal(deep + " = 1").find("6000 dots"), std::string::npos);
    EXPECT_NE(refusal("[x]\nb = \"it's\"\n" + deep + " = 'it\"s'").find("6000 dots"), std::string::npos);
}

TEST(ArtifactFile, names_the_command_that_creates_a_missing_file) {
    const Result<ArtifactFile> none = read_artifact_file("/nowhere/vase");
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message,
              "/nowhere/vase: there is no artifact.toml in this folder; frustumscreen-bake --new "
              "/nowhere/vase SCAN writes one to start from");
}
