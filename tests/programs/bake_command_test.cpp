// The files that `frustumscreen-bake` writes, and those that it never replaces.

#include "app/image/image.h"
#include "app/pack/attribution.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_texts.h"
#include "firmware_host/base/json.h"
#include "tests/base/told.h"
#include "tests/folders.h"
#include "tests/programs/program_folder.h"
#include "tests/texts/wav_bytes.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;

class BakeCommand : public ProgramFolder {
protected:
    void SetUp() override {
        put("scan.obj", "mtllib scan.mtl\n"
                        "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 1 0\n"
                        "vt 0 0\nvt 1 0\nvt 0 1\n"
                        "usemtl skin\n"
                        "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 1/1 4/2 3/3\nf 2/1 3/2 4/3\n");
        put("scan.mtl", "newmtl skin\nKd 1 1 1\nmap_Kd skin.png\nmap_Ks shine.png\n");
        const Bytes picture = image::encode_png(image::Image8(4, 4, {200, 120, 60, 255}));
        ASSERT_TRUE(write_file(folder / "skin.png", picture));
        ASSERT_TRUE(write_file(folder / "shine.png", picture));
        put("notes.txt", "what the curator wrote down");
    }
    [[nodiscard]] int bake_to(const std::string& output, const std::string& more = "") const {
        return run(fmt::format("frustumscreen-bake scan.obj --size 32 -o '{}' {}", output, more));
    }
    /// Expects that the bake ends with one line that contains `reason`, and that every file of the folder is unchanged.
    void refused(const std::string& output, const std::string& reason, const std::string& more = "") const {
        constexpr std::array files = {"scan.obj", "scan.mtl", "skin.png", "shine.png", "notes.txt"};
        std::array<std::string, files.size()> before;
        std::transform(files.begin(), files.end(), before.begin(),
                       [&](const char* file) { return text(file); });
        EXPECT_EQ(bake_to(output, more), 1) << output;
        for (std::size_t k = 0; k < files.size(); ++k) {
            EXPECT_EQ(text(files[k]), before[k]) << files[k] << " was replaced by -o " << output;
        }
        const std::string said = text("err.txt");
        EXPECT_NE(said.find(reason), std::string::npos) << said;
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    }
};

TEST_F(BakeCommand, WritesAPackAndReplacesAPack) {
    for (int time = 0; time < 2; ++time) {
        ASSERT_EQ(bake_to("scan.fspack"), 0) << text("err.txt");
        EXPECT_TRUE(pack::load_pack(folder / "scan.fspack"));
    }
}

TEST_F(BakeCommand, KilledBakeKeepsTheOldPackAndTheNextOneCleansUp) {
    ASSERT_EQ(bake_to("scan.fspack"), 0) << text("err.txt");
    for (const char* seconds : {"0.02", "0.1", "0.2", "0.3", "0.5"}) {
        const std::string command = fmt::format("cd '{}' && timeout -s KILL {} '{}'/frustumscreen-bake "
                                                "scan.obj --size 32 -o scan.fspack >out.txt 2>&1",
                                                folder.string(), seconds, bin_dir());
        (void)std::system(command.c_str());
        EXPECT_TRUE(pack::load_pack(folder / "scan.fspack")) << seconds;
    }
    put("scan.fspack.part4194303", "half"); // of a process that is no more
    ASSERT_EQ(bake_to("scan.fspack"), 0) << text("err.txt");
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
    }
}

TEST_F(BakeCommand, ReportsItsResultOnOneScreen) {
    ASSERT_EQ(bake_to("scan.fspack"), 0) << text("err.txt");
    EXPECT_EQ(text("err.txt"), "");
    const std::string said = text("out.txt");
    for (const char* part : {"scan.fspack: \"scan\" (en), ", "mm wide", "up is the file's +y", "its +z ",
                             "triangles", "shown unless the machine needs another", "lost    nothing"}) {
        EXPECT_NE(said.find(part), std::string::npos) << part << "\n" << said;
    }
    EXPECT_LE(std::count(said.begin(), said.end(), '\n'), 24) << said;
}

TEST_F(BakeCommand, JsonReportMatchesThePack) {
    ASSERT_EQ(bake_to("scan.fspack", "--json --up z --turn 30 --scale 0.5 --lift 0.25"), 0)
        << text("err.txt");
    const nlohmann::json report = nlohmann::json::parse(text("out.txt"));
    const Result<pack::VerifiedPack> pack = pack::load_pack(folder / "scan.fspack");
    ASSERT_TRUE(pack) << pack.error().message;
    EXPECT_EQ(report["bytes"], fs::file_size(folder / "scan.fspack"));
    EXPECT_GT(report["processor_seconds"], 0.0);
    EXPECT_GT(report["memory_bytes"], 5'000'000U);
    EXPECT_EQ(report["up"], "+z");
    EXPECT_EQ(report["turn_deg"], 30.0);
    EXPECT_EQ(report["levels"].size(), (*pack)->levels.size());
    EXPECT_EQ(report["lost"].size(), 0U);
    // The tetrahedron's corners, computed by hand: up is z, turned by 30 degrees, raised by a quarter of its height 1.
    const double c = std::sqrt(0.75);
    const double wide = c + 0.5;
    const double longest = std::max(wide, 1.25);
    EXPECT_NEAR((*pack)->box_size.x, wide / longest, 1e-6);
    EXPECT_NEAR((*pack)->box_size.z, 1.25 / longest, 1e-6);
    const pack::Placement placement = pack::place(**pack, geometry::make_frustum(geometry::shipped_frustum));
    const glm::dvec3 foot(placement.prop_from_artifact * glm::dvec4(0, 0, 0, 1));
    const glm::dvec3 tip(placement.prop_from_artifact * glm::dvec4(0, 0, 1, 1));
    EXPECT_NEAR(foot.z, 0.25 * (tip.z - foot.z), 1e-9);
    EXPECT_NEAR(report["size_m"][2], tip.z - foot.z, 1e-4); // 16-bit positions
    ASSERT_EQ(bake_to("whole.fspack", "--up z --turn 30 --lift 0.25"), 0) << text("err.txt");
    const Result<pack::VerifiedPack> whole = pack::load_pack(folder / "whole.fspack");
    EXPECT_NEAR(pack::place(**whole, geometry::make_frustum(geometry::shipped_frustum)).metres_per_box,
                2.0 * placement.metres_per_box, 1e-12);
}

TEST_F(BakeCommand, ReportsLossesOrRefusesThemWithStrict) {
    fs::remove(folder / "scan.mtl");
    ASSERT_EQ(bake_to("scan.fspack"), 0) << text("err.txt");
    EXPECT_NE(text("err.txt").find("scan.obj: lost: the colours: it names \"scan.mtl\""), std::string::npos);
    EXPECT_NE(text("out.txt").find("lost    the colours"), std::string::npos);
    EXPECT_EQ(bake_to("strict.fspack", "--strict"), 1);
    EXPECT_NE(text("err.txt").find("--strict forbids it: the colours"), std::string::npos) << text("err.txt");
    EXPECT_FALSE(fs::exists(folder / "strict.fspack"));
    ASSERT_EQ(bake_to("strict.fspack", "--strict --texture skin.png"), 0) << text("err.txt");
    EXPECT_EQ(text("err.txt"), "");
    EXPECT_TRUE(pack::load_pack(folder / "strict.fspack"));
    EXPECT_EQ(bake_to("skin.png", "--force --texture skin.png"), 1) << "the picture is an input";
}

TEST_F(BakeCommand, TakesTitleAuthorAndLicenceFromTheFileAndReportsThem) {
    put("scan.mtl",
        "# Title: Small jar\n# Author: Ann\n# License: CC-BY-4.0\nnewmtl skin\nKd 1 1 1\nmap_Kd skin.png\n");
    ASSERT_EQ(bake_to("Jar of Ann.fspack", "--json"), 0) << text("err.txt");
    nlohmann::json report = nlohmann::json::parse(text("out.txt"));
    EXPECT_EQ(report["title"], "Small jar");
    EXPECT_EQ(report["author"], "Ann");
    EXPECT_EQ(report["licence"], "CC-BY-4.0");
    EXPECT_EQ(report["missing"].size(), 0U) << report["missing"];
    EXPECT_EQ(report["taken"].size(), 2U) << "from the file, and the id";
    Result<pack::VerifiedPack> pack = pack::load_pack(folder / "Jar of Ann.fspack");
    ASSERT_TRUE(pack);
    EXPECT_EQ(pack::scan_rights(**pack).value(), (pack::ScanRights{"CC-BY-4.0", "Ann", ""}));
    EXPECT_EQ(report["id"], (*pack)->id);
    EXPECT_TRUE((*pack)->id.starts_with("jar-of-ann-")) << (*pack)->id;

    ASSERT_EQ(bake_to("jar.fspack", "--licence CC0-1.0 --author Bo --title Jug"), 0) << text("err.txt");
    pack = pack::load_pack(folder / "jar.fspack");
    EXPECT_EQ(pack::scan_rights(**pack).value(), (pack::ScanRights{"CC0-1.0", "Bo", ""}));
    EXPECT_EQ((*pack)->title, "Jug");
    EXPECT_EQ((*pack)->id, "jar");
    EXPECT_NE(
        text("out.txt").find("guessed the licence is \"CC0-1.0\", as given; the file says \"CC-BY-4.0\""),
        std::string::npos)
        << text("out.txt");
    EXPECT_NE(text("out.txt").find("taken   the id \"jar\" from the pack's name"), std::string::npos);
}

TEST_F(BakeCommand, BakeAndSignReportMissingLicenceAndAuthor) {
    ASSERT_EQ(bake_to("scan.fspack"), 0) << text("err.txt");
    EXPECT_NE(text("out.txt").find("missing the licence:"), std::string::npos) << text("out.txt");
    ASSERT_EQ(run("frustumscreen-pack keygen -o key < /dev/null"), 0) << text("err.txt");
    ASSERT_EQ(run("frustumscreen-pack sign scan.fspack --key key.key"), 0) << text("err.txt");
    EXPECT_NE(text("out.txt").find("scan.fspack: missing: the licence:"), std::string::npos)
        << text("out.txt");
    ASSERT_EQ(bake_to("scan.fspack", "--licence CC-BY-4.0"), 0);
    EXPECT_NE(text("out.txt").find("missing the author:"), std::string::npos) << text("out.txt");
    ASSERT_EQ(run("frustumscreen-pack sign scan.fspack --key key.key --json"), 0);
    EXPECT_EQ(nlohmann::json::parse(text("out.txt"))[0]["missing"].size(), 1U) << text("out.txt");
    ASSERT_EQ(bake_to("scan.fspack", "--licence CC-BY-4.0 --author Ann"), 0);
    EXPECT_EQ(text("out.txt").find("missing"), std::string::npos) << text("out.txt");
}

TEST_F(BakeCommand, DerivesAUniqueAndStableIdFromTheName) {
    const auto id_of = [&](const std::string& name) {
        EXPECT_EQ(bake_to(name), 0) << text("err.txt");
        const Result<pack::VerifiedPack> pack = pack::load_pack(folder / name);
        return pack ? (*pack)->id : std::string();
    };
    EXPECT_EQ(id_of("vase_2.old.fspack"), "vase_2.old");
    EXPECT_EQ(id_of("Vase.fspack"), "vase");
    const std::set<std::string> others{id_of("löwe.fspack"), id_of("lüwe.fspack"), id_of("猫.fspack"),
                                       id_of("_.fspack"), id_of(std::string(100, 'v') + ".fspack")};
    EXPECT_EQ(others.size(), 5U);
    EXPECT_TRUE(others.contains(id_of("löwe.fspack"))) << "again the same";
}

TEST_F(BakeCommand, TypesetsAFoldersTextsAndSpeaksItsDescription) {
    fs::create_directories(folder / "vase");
    for (const char* file : {"scan.obj", "scan.mtl", "skin.png", "shine.png"}) {
        fs::copy_file(folder / file, folder / "vase" / file);
    }
    put("vase/artifact.toml", "scan = \"scan.obj\"\nsize = 32\n"
                              "[[texts]]\nlanguage = \"en\"\ntitle = \"Vase\"\ndescription = \"A vase.\"\n"
                              "[[texts]]\nlanguage = \"he\"\ntitle = \"\u05db\u05d3\"\n"
                              "description = \"\u05db\u05d3 \u05dc\u05d1\u05df\"\n");
    ASSERT_TRUE(write_file(folder / "tone.wav", testing::wav16(testing::sine(0.2, 0.5))));
    ASSERT_EQ(run("frustumscreen-bake vase -o vase.fspack --strict --json --speech 'cat tone.wav'"), 0)
        << text("err.txt");
    EXPECT_EQ(nlohmann::json::parse(text("out.txt"))["spoken"], nlohmann::json({"en", "he"}));
    const std::vector<std::string> both{"he", "en"};
    const Result<std::vector<pack::SetLanguage>> set = pack::load_set_texts(folder / "vase.fspack", both);
    ASSERT_TRUE(set) << set.error().message;
    ASSERT_EQ(set->size(), 2U);
    EXPECT_EQ((*set)[1].runs.find("title")->direction, pack::TextDirection::RightToLeft);
    EXPECT_NE((*set)[1].runs.find("description.0"), nullptr);
    EXPECT_FALSE(pack::load_sound(folder / "vase.fspack", "he", "description")->empty());
    EXPECT_EQ(run("frustumscreen-pack verify vase.fspack"), 0) << text("err.txt");

    ASSERT_EQ(run("frustumscreen-bake vase -o vase.fspack"), 0) << text("err.txt"); // with the default voice
    EXPECT_NE(text("out.txt").find("silent  the description in 'he' is silent, but it is shown"),
              std::string::npos)
        << text("out.txt");
    ASSERT_EQ(run("frustumscreen-pack explain vase.fspack"), 0);
    EXPECT_NE(text("out.txt").find("silent: the description is shown, but no voice speaks it"),
              std::string::npos);
}

TEST_F(BakeCommand, ReportsTextThatCannotBeTypesetOrRefusesItWithStrict) {
    const std::string caption = " --language en --caption 'en=A vase \xf0\x9f\x98\x80.'";
    ASSERT_EQ(bake_to("scan.fspack", caption), 0) << text("err.txt");
    EXPECT_NE(text("err.txt").find("lost: texts in 'en': text: the letter"), std::string::npos)
        << text("err.txt");
    ASSERT_EQ(run("frustumscreen-pack explain --json scan.fspack"), 0);
    EXPECT_EQ(nlohmann::json::parse(text("out.txt"))["captions"][0]["text"], "A vase \xf0\x9f\x98\x80.");
    EXPECT_EQ(bake_to("strict.fspack", "--strict" + caption), 1);
    EXPECT_FALSE(fs::exists(folder / "strict.fspack"));
}

TEST_F(BakeCommand, RemovesThePartFileOfAKilledRun) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
    const std::string left = "scan.fspack.part" + std::to_string(child);
    put(left, "half a pack");
    ASSERT_EQ(bake_to("scan.fspack"), 0) << text("err.txt");
    EXPECT_FALSE(fs::exists(folder / left));
}

TEST_F(BakeCommand, StoresAReliefUnlessToldNotTo) {
    ASSERT_EQ(bake_to("with.fspack"), 0) << text("err.txt");
    ASSERT_EQ(bake_to("without.fspack", "--no-relief"), 0) << text("err.txt");
    for (const std::string name : {"with", "without"}) {
        ASSERT_EQ(run("frustumscreen-pack verify " + name + ".fspack"), 0) << text("err.txt");
    }
    const auto holds_relief = [this](const char* pack) {
        return text(pack).find("relief_blocks/") != std::string::npos;
    };
    EXPECT_TRUE(holds_relief("with.fspack"));
    EXPECT_FALSE(holds_relief("without.fspack"));
}

TEST_F(BakeCommand, ThePreviewShowsFourSides) {
    ASSERT_EQ(bake_to("scan.fspack", "--unlit"), 0) << text("err.txt");
    ASSERT_EQ(run("frustumscreen-pack preview scan.fspack -o sides.png"), 0) << text("err.txt");
    const Result<Bytes> file = read_file(folder / "sides.png");
    ASSERT_TRUE(file) << file.error().message;
    const Result<image::Image8> picture = image::decode_png8(*file, 1 << 24);
    ASSERT_TRUE(picture) << picture.error().message;
    std::array<int, 4> lit{};
    for (int y = 0; y < picture->height; ++y) {
        for (int x = 0; x < picture->width; ++x) {
            const glm::u8vec4 texel = picture->at(x, y);
            const bool skin =
                std::abs(texel.r - 200) < 4 && std::abs(texel.g - 120) < 4 && std::abs(texel.b - 60) < 4;
            lit[static_cast<std::size_t>(4 * x / picture->width)] += skin ? 1 : 0;
        }
    }
    for (const int pixels : lit) {
        EXPECT_GT(pixels, 10'000) << "of the artifact's own colour, on each side";
    }
    EXPECT_EQ(run("frustumscreen-pack preview scan.obj -o sides.png"), 1);
    EXPECT_EQ(run("frustumscreen-pack preview scan.fspack -o scan.fspack"), 1);
    EXPECT_TRUE(pack::load_pack(folder / "scan.fspack")) << "its input is as it was";
}

TEST_F(BakeCommand, NeverReplacesItsInput) {
    fs::create_symlink("scan.obj", folder / "link.obj");
    fs::create_hard_link(folder / "scan.obj", folder / "second.obj");
    for (const char* output : {"scan.obj", "./scan.obj", "link.obj", "second.obj"}) {
        refused(output, "would replace the input scan.obj");
        refused(output, "would replace the input scan.obj", "--force");
    }
}

TEST_F(BakeCommand, NeverReplacesAFileThatTheModelNames) {
    for (const char* output : {"scan.mtl", "skin.png", "shine.png"}) {
        refused(output, "is not a pack");
        refused(output, fmt::format("would replace the input {}", output), "--force");
    }
}

TEST_F(BakeCommand, ReplacesAnotherFileOnlyByForce) {
    refused("notes.txt", "notes.txt: this file exists and is not a pack");
    ASSERT_EQ(bake_to("notes.txt", "--force"), 0) << text("err.txt");
    EXPECT_TRUE(pack::load_pack(folder / "notes.txt"));
}

TEST_F(BakeCommand, ChecksTheOutputBeforeTheWork) {
    put("scan.obj", "no model at all"); // errors of the output are reported before it is read
    fs::create_directory(folder / "folder");
    refused("nowhere/scan.fspack", "there is no folder nowhere; make it first");
    refused("folder", "not a regular file");
    refused("/proc/scan.fspack", "/proc: nothing can be written into this folder");
}

TEST_F(BakeCommand, RejectsDuplicateAndUnknownLanguagesAndCaptions) {
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"--caption 'en=A cat.' --caption 'en=A dog.'",
         "--caption 'en=A dog.': there is a caption in en already; write one for each language"},
        {"--language en --language de --language en", "--language 'en': it is named twice"},
        {"--language en --language EN", "--language 'EN': it is named twice"},
        {"--language english",
         "--language 'english': there is no such language; allowed are language tags such as"},
        {"--language xx", "--language 'xx': there is no such language"},
        {"--caption 'de=Eine Katze.'", "--caption 'de=Eine Katze.': the languages are en; add --language de"},
        {"--caption 'A cat.'", "--caption 'A cat.': write LANGUAGE=TEXT"}};
    for (const auto& [arguments, message] : wrong) {
        EXPECT_EQ(bake_to("scan.fspack", arguments), 2) << arguments;
        const std::string said = text("err.txt");
        EXPECT_EQ(said.rfind("frustumscreen-bake: " + message, 0), 0U) << said;
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
        EXPECT_FALSE(fs::exists(folder / "scan.fspack"));
    }
    ASSERT_EQ(
        bake_to("scan.fspack", "--title Cat --language en --language DE --caption 'de=Eine Katze=Kater.'"), 0)
        << text("err.txt");
    const auto pack = pack::load_pack(folder / "scan.fspack");
    ASSERT_TRUE(pack);
    ASSERT_EQ((*pack)->captions.size(), 2U);
    EXPECT_EQ((*pack)->captions[0].text, "");
    EXPECT_EQ((*pack)->captions[1].title, "Cat");
    EXPECT_EQ((*pack)->captions[1].text, "Eine Katze=Kater.");
}

TEST_F(BakeCommand, BakesAFolder) {
    ASSERT_EQ(run("frustumscreen-bake scan.obj --new vase"), 0) << text("err.txt");
    EXPECT_NE(text("out.txt").find("vase/artifact.toml: edit it"), std::string::npos) << text("out.txt");
    EXPECT_EQ(text("vase/skin.png"), text("skin.png")) << "what the scan names comes along";
    ASSERT_EQ(run("frustumscreen-bake vase -o new.fspack --size 32"), 0) << text("err.txt");
    put("vase/artifact.toml", R"(scan = "scan.obj"
id = "vase-1"
licence = "CC0-1.0"
size = 48
[placement]
up = "z"
turn_deg = 0
[[texts]]
language = "de"
title = "Vase"
credit = "Geschenk"
text = "Eine Vase."
[[texts]]
language = "en"
title = "A vase"
description = "It is small."
[[hotspots]]
point = [0.2, 0.2, 0.0]
labels = { en = "Foot", de = "Fuß" }
[[hotspots]]
point = [0.3, 0.0, 0.3]
labels = { en = "Side" }
)");
    ASSERT_EQ(run("frustumscreen-bake vase -o vase.fspack --json"), 1) << "the first point is below the foot";
    EXPECT_NE(text("err.txt").find(
                  "artifact.toml:18: hotspots[0].point is [0.2, 0.2, 0], where no visitor can see"),
              std::string::npos)
        << text("err.txt");
    std::string file = text("vase/artifact.toml");
    file.replace(file.find("[0.2, 0.2, 0.0]"), 15, "[0.0, 0.2, 0.2]");
    put("vase/artifact.toml", file);
    ASSERT_EQ(run("frustumscreen-bake vase -o vase.fspack"), 0) << text("err.txt");
    const auto pack = pack::load_pack(folder / "vase.fspack");
    ASSERT_TRUE(pack) << pack.error().message;
    EXPECT_EQ((*pack)->id, "vase-1");
    EXPECT_EQ((*pack)->title, "Vase");
    EXPECT_EQ((*pack)->languages, (std::vector<std::string>{"de", "en"}));
    EXPECT_EQ((*pack)->captions[0].credit, "Geschenk");
    EXPECT_EQ((*pack)->captions[1].title, "A vase");
    EXPECT_EQ((*pack)->captions[1].description, "It is small.");
    EXPECT_EQ((*pack)->provenance.licence, "CC0-1.0");
    EXPECT_EQ((*pack)->relief_size, 48);
    ASSERT_EQ((*pack)->hotspots.size(), 2U);
    // The tetrahedron fills its box; the box's X is the file's, and its front, -Y, is at the file's y = 0.
    EXPECT_NEAR((*pack)->hotspots[0].point.x, -0.5, 1e-6);
    EXPECT_NEAR((*pack)->hotspots[0].normal.x, -1.0, 0.01);
    EXPECT_NEAR((*pack)->hotspots[1].point.y, -0.5, 1e-6);
    EXPECT_NEAR((*pack)->hotspots[1].point.z, 0.3, 1e-6);
    EXPECT_NEAR((*pack)->hotspots[1].normal.y, -1.0, 0.01);
    EXPECT_EQ(std::max((*pack)->table_picture.width, (*pack)->table_picture.height), 256);
}

TEST_F(BakeCommand, OptionsOverrideTheFolder) {
    fs::create_directory(folder / "vase");
    for (const char* file : {"scan.obj", "scan.mtl", "skin.png"}) {
        fs::copy_file(folder / file, folder / "vase" / file);
    }
    put("vase/artifact.toml",
        "scan = \"scan.obj\"\nlicence = \"a\"\nsize = 2000\nprop = \"cube\"\n[placement]\n"
        "scale = 0.5\nup = \"x\"\n[[texts]]\nlanguage = \"de\"\ntitle = \"Vase\"\n"
        "text = \"Eine Vase.\"\n[[texts]]\nlanguage = \"fr\"\nplace = \"Paris\"\n");
    ASSERT_EQ(run("frustumscreen-bake vase -o a.fspack --size 32 --prop frustum --scale 2 --licence b "
                  "--language fr "
                  "--language en --caption 'fr=Un vase.' --up z"),
              0)
        << text("err.txt");
    const auto pack = pack::load_pack(folder / "a.fspack");
    ASSERT_TRUE(pack) << pack.error().message;
    EXPECT_EQ((*pack)->prop_kind, "frustum");
    EXPECT_EQ((*pack)->scale, 2.0);
    EXPECT_EQ((*pack)->provenance.licence, "b");
    ASSERT_EQ((*pack)->captions.size(), 2U);
    EXPECT_TRUE((*pack)->captions[0] ==
                (pack::PackCaption{"fr", "Vase", "Un vase.", "", "Paris", "", "", ""}));
    EXPECT_TRUE((*pack)->captions[1] == (pack::PackCaption{"en", "scan", ""}));
    EXPECT_EQ(run("frustumscreen-bake vase -o vase/artifact.toml --force"), 1) << "it is an input";
    EXPECT_EQ(run("frustumscreen-bake vase"), 2) << "no output is named";
    put("vase/artifact.toml", "scan = \"scan.obj\"\nlicense = \"a\"\n");
    EXPECT_EQ(run("frustumscreen-bake vase -o b.fspack"), 1);
    EXPECT_TRUE(test::tells(text("err.txt"), {"frustumscreen-bake: vase/artifact.toml:2: license ", "licence",
                                              "[settings.unknown_key]\n"}));
    EXPECT_EQ(run("frustumscreen-bake scan.obj -o b.fspack --title 'a\x1b[2J'"), 2);
    EXPECT_FALSE(fs::exists(folder / "b.fspack"));
}

TEST_F(BakeCommand, TablePictureHasATransparentBackground) {
    ASSERT_EQ(bake_to("scan.fspack"), 0) << text("err.txt");
    ASSERT_EQ(run("frustumscreen-pack preview scan.fspack --table -o table.png"), 0) << text("err.txt");
    const Result<Bytes> file = read_file(folder / "table.png");
    ASSERT_TRUE(file);
    const Result<image::Image8> picture = image::decode_png8(*file, 1 << 24);
    ASSERT_TRUE(picture);
    EXPECT_EQ(std::max(picture->width, picture->height), 256);
    EXPECT_EQ(picture->at(0, 0).a, 0);
    EXPECT_EQ(picture->at(picture->width / 2, picture->height / 2).a, 255);
}

/// A file system of one megabyte; skipped if the test may not make one.
TEST_F(BakeCommand, ChecksFreeSpaceBeforeTheWork) {
    fs::create_directory(folder / "small");
    const std::string program = fmt::format("'{}'/frustumscreen-bake", bin_dir());
    const int status = std::system(
        fmt::format(
            "cd '{}' && ASAN_OPTIONS=detect_leaks=0 unshare --map-root-user --mount sh -c 'mount -t tmpfs -o "
            "size=1m none small && {{ {} scan.obj --size 32 -o small/scan.fspack 2>err.txt; test $? = 1; }}' "
            "2>unshare.txt",
            folder.string(), program)
            .c_str());
    if (!fs::exists(folder / "err.txt")) {
        GTEST_SKIP() << "no file system of our own can be mounted here: " << text("unshare.txt");
    }
    EXPECT_EQ(status, 0);
    EXPECT_NE(text("err.txt").find("small: 1 MB are left there, and up to "), std::string::npos)
        << text("err.txt");
}

} // namespace
} // namespace frustumscreen::programs
