// The messages of `frustumscreen-bake` about a curator's folder: losses and errors.
#include "app/pack/pack_file.h"
#include "tests/base/told.h"
#include "tests/programs/program_folder.h"
#include "tests/texts/wav_bytes.h"

#include <algorithm>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;

class BakeFolder : public ProgramFolder {
protected:
    void SetUp() override {
        fs::create_directory(folder / "jug");
        put("jug/jug.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 1 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    }
    /// Exit status of a bake with these lines in the artifact.toml.
    [[nodiscard]] int bake(const std::string& lines, const std::string& more = "") const {
        put("jug/artifact.toml", "scan = \"jug.obj\"\nsize = 16\n" + lines);
        return run("frustumscreen-bake jug -o jug.fspack " + (more.empty() ? "--speech none" : more));
    }
    /// True if standard error contains `part`.
    [[nodiscard]] ::testing::AssertionResult said(const std::string& part) const {
        const std::string all = text("err.txt");
        return (all.find(part) != std::string::npos ? ::testing::AssertionSuccess()
                                                    : ::testing::AssertionFailure())
               << all;
    }
};

constexpr const char* english_and_german =
    "[[texts]]\nlanguage = \"en\"\ntitle = \"Jug\"\n[[texts]]\nlanguage = \"de\"\ntitle = \"Krug\"\n";

TEST_F(BakeFolder, ReportsWrongUseInOneLineWithAdvice) {
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"jug", "-o NAME.fspack, the pack to write, is required"},
        {"--new jug2", "the scan, after the folder of --new, is required"},
        {"-o jug.fspack", "INPUT, a scan or a folder with an artifact.toml, is required"},
        {"jug -o jug.fspack --preveiw jug.html",
         "'--preveiw' is not expected here; the nearest option is --preview"},
        {"jug -o jug.fspack --licens=CC0",
         "'--licens=CC0' is not expected here; the nearest option is --licence"},
        {"jug bowl -o jug.fspack", "'bowl' is not expected here"}};
    for (const auto& [arguments, message] : wrong) {
        EXPECT_EQ(run("frustumscreen-bake " + arguments), 2) << arguments;
        EXPECT_EQ(text("err.txt"),
                  "frustumscreen-bake: " + message + "; frustumscreen-bake --help says more\n");
    }
    EXPECT_FALSE(fs::exists(folder / "jug.fspack"));
}

TEST_F(BakeFolder, FindsARecordingInAFolderOfAnyCase) {
    fs::create_directories(folder / "jug/Recordings/EN");
    ASSERT_TRUE(
        write_file(folder / "jug/Recordings/EN/description.wav", testing::wav16(testing::sine(0.5, 1.0))));
    ASSERT_EQ(bake("[[texts]]\nlanguage = \"en\"\ntitle = \"Jug\"\ndescription = \"A jug.\"\n"), 0)
        << text("err.txt");
    EXPECT_NE(text("out.txt").find("spoken  the description in en"), std::string::npos) << text("out.txt");
    EXPECT_EQ(text("err.txt"), "");
}

TEST_F(BakeFolder, HintsAtAnUnusedFileWithoutALoss) {
    put("jug/jug.txt", "notes of the curator");
    const std::string lines = "[[texts]]\nlanguage = \"en\"\ntitle = \"Jug\"\n";
    ASSERT_EQ(bake(lines, "--speech none --strict"), 0) << text("err.txt");
    EXPECT_NE(text("out.txt").find("that jug.txt beside artifact.toml is not used"), std::string::npos)
        << text("out.txt");
    fs::remove(folder / "jug/jug.txt");
    ASSERT_EQ(bake(lines, "--speech none"), 0) << text("err.txt");
    EXPECT_EQ(text("out.txt").find("is not used"), std::string::npos) << text("out.txt");
}

TEST_F(BakeFolder, ReportsLabelsAndTextsOfDifferentLanguages) {
    const std::string lines =
        std::string(english_and_german) +
        "[[hotspots]]\npoint = [0.0, 0.2, 0.2]\nlabels = { en = \"Side\", fr = \"Flanc\" }\n";
    ASSERT_EQ(bake(lines), 0) << text("err.txt");
    EXPECT_TRUE(said("lost: hotspots[0] has no label in 'de', so none is shown there; write de = "
                     "\"...\" under labels"));
    EXPECT_TRUE(said("lost: hotspots[0] has the label \"Flanc\" in 'fr', and the artifact has no "
                     "[[texts]] in that language; write them, or take the label away"));
    fs::remove(folder / "jug.fspack");
    EXPECT_EQ(bake(lines, "--speech none --strict"), 1);
    EXPECT_FALSE(fs::exists(folder / "jug.fspack"));
    const std::string both =
        std::string(english_and_german) +
        "[[hotspots]]\npoint = [0.0, 0.2, 0.2]\nlabels = { en = \"Side\", de = \"Seite\" }\n";
    EXPECT_EQ(bake(both, "--speech none --strict --language en"), 0)
        << "German is left out on purpose: " << text("err.txt");
}

TEST_F(BakeFolder, ReportsAPointOffTheSurfaceBeforeSynthesizingSpeech) {
    const std::string lines = "[[texts]]\nlanguage = \"en\"\ndescription = \"A jug.\"\n"
                              "[[hotspots]]\npoint = [0, 1200, 0]\nlabels = { en = \"Side\" }\n";
    EXPECT_EQ(bake(lines, "--turn 0 --speech false"), 1);
    EXPECT_TRUE(test::tells(text("err.txt"),
                            {"frustumscreen-bake: jug/artifact.toml:7: hotspots[0].point is [0, 1200, 0]",
                             "1199 times", "5 %", "[0, 1, 0]", "[hotspot.away_from_surface]\n"}));
    const std::size_t at = lines.find("1200");
    EXPECT_EQ(bake(std::string(lines).replace(at, 4, "1.25"), "--turn 0 --speech false"), 1);
    EXPECT_TRUE(said("which is 25.0 % of the artifact's size away"));
}

TEST_F(BakeFolder, AcceptsTheArtifactFileInPlaceOfItsFolder) {
    ASSERT_EQ(bake("[[texts]]\nlanguage = \"en\"\ntitle = \"Jug\"\n"), 0) << text("err.txt");
    ASSERT_EQ(run("frustumscreen-bake jug/artifact.toml -o again.fspack --speech none"), 0)
        << text("err.txt");
    EXPECT_EQ((*pack::load_pack(folder / "again.fspack"))->title, "Jug");
    ASSERT_EQ(run("frustumscreen-bake artifact.toml -o again.fspack"), 1) << "there is none here";
}

} // namespace
} // namespace frustumscreen::programs
