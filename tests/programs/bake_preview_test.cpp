// `frustumscreen-bake --preview` and `--watch`: the curator's page, also opened in a browser without a network.
#include "tests/base/told.h"
#include "tests/folders.h"
#include "tests/programs/curator_folder.h"

#include <algorithm>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;

constexpr const char* texts = "licence = \"CC0-1.0\"\n"
                              "[[texts]]\nlanguage = \"en\"\ntitle = \"Jug <b>& \\\"co\\\"\"\n"
                              "text = \"Of clay.\"\ndescription = \"A jug.\"\nrecording = \"jug.wav\"\n"
                              "[[texts]]\nlanguage = \"ar\"\ntitle = \"جرة\"\n"
                              "[[hotspots]]\npoint = [0.0, 0.2, 0.2]\nlabels = { en = \"Side\" }\n";

/// The <html> tag of a page in Chromium without a network; the page's script writes its result there.
std::string root_in_chromium(const fs::path& folder, const std::string& page) {
    const bool cuts_off = std::system("unshare -n true 2>/dev/null") == 0;
    const std::string command = fmt::format(
        "cd '{}' && HOME=\"$PWD\" timeout 120 {} chromium --headless --no-sandbox --disable-gpu "
        "--disable-quic "
        "--no-first-run --disable-background-networking --disable-component-update --disable-sync "
        "--user-data-dir=profile --virtual-time-budget=1000 --dump-dom \"file://$PWD/{}\" >dom.html "
        "2>chromium.txt",
        folder.string(), cuts_off ? "unshare -n" : "", page);
    EXPECT_EQ(std::system(command.c_str()), 0);
    const Result<Bytes> dom = read_file(folder / "dom.html");
    const std::string_view text = dom ? as_text(*dom) : std::string_view();
    const std::size_t begin = std::min(text.find("<html"), text.size());
    return std::string(text.substr(begin, text.find('>', begin) - begin));
}

class BakePreview : public CuratorFolder {
protected:
    void SetUp() override {
        put_jug("jug", texts);
        put_recording("jug/jug.wav");
    }
    [[nodiscard]] int check(const std::string& options) const {
        return std::system(fmt::format("'{}/tests/preview/check_page.py' '{}/jug.html' {}", source_dir(),
                                       folder.string(), options)
                               .c_str());
    }
};

TEST_F(BakePreview, PageShowsPicturesTextsSoundAndErrorsInABrowser) {
    ASSERT_EQ(run("frustumscreen-bake jug -o jug.fspack --preview jug.html --while-watched --speech none"), 0)
        << text("err.txt");
    // The turn, the table's picture, two captions, a portion, the attribution in both languages, a label.
    EXPECT_EQ(
        check("--reloads --pictures 8 --sounds 1 --text 'Jug <b>& \"co\"' --text 'Of clay.' --text 'A jug.' "
              "--text 'جرة' --text Side --text CC0-1.0 --text 'mean mm' --text \"has no label in 'ar'\""),
        0);
    EXPECT_NE(text("out.txt").find("  page    jug.html, "), std::string::npos) << text("out.txt");
    EXPECT_LT(fs::file_size(folder / "jug.html"), 4'000'000U);
    if (std::system("command -v chromium >/dev/null") != 0) {
        GTEST_SKIP() << "chromium is not installed; the rest was checked";
    }
    const std::string root = root_in_chromium(folder, "jug.html");
    EXPECT_NE(root.find("data-pictures=\"8 of 8\""), std::string::npos) << root;
    EXPECT_NE(root.find("data-sounds=\"1 of 1\""), std::string::npos) << root;
    EXPECT_EQ(root.find("data-blocked"), std::string::npos) << root;
}

TEST_F(BakePreview, NeverReplacesAForeignFile) {
    put("jug.html", "a letter");
    EXPECT_EQ(run("frustumscreen-bake jug -o jug.fspack --preview jug.html --speech none"), 1);
    EXPECT_TRUE(test::tells(text("err.txt"),
                            {"frustumscreen-bake: jug.html: ", "--force", "[preview.not_a_page]\n"}));
    EXPECT_EQ(text("jug.html"), "a letter");
    EXPECT_EQ(run("frustumscreen-bake jug -o jug.fspack --preview jug/artifact.toml --force --speech none"),
              1);
    EXPECT_EQ(run("frustumscreen-bake jug -o jug.fspack --preview ./jug.fspack --force --speech none"), 1);
    EXPECT_EQ(run("frustumscreen-bake jug -o jug.fspack --preview nowhere/jug.html --speech none"), 1);
    EXPECT_FALSE(fs::exists(folder / "jug.fspack")) << "all this is said before the work";
}

TEST_F(BakePreview, ReportsMissingOpenGlInOneLine) {
    // A loader that is given no driver finds none.
    EXPECT_EQ(
        std::system(
            fmt::format("cd '{}' && __EGL_VENDOR_LIBRARY_FILENAMES=/nowhere.json '{}'/frustumscreen-bake jug "
                        "-o jug.fspack --preview jug.html --speech none 2>err.txt",
                        folder.string(), bin_dir())
                .c_str()),
        256)
        << text("err.txt");
    EXPECT_EQ(count("err.txt", "\n"), 1U);
    EXPECT_NE(text("err.txt").find("jug.html: the preview cannot be drawn on this computer: "),
              std::string::npos)
        << text("err.txt");
}

TEST_F(BakePreview, WatchRedrawsOnChangeAndKeepsThePageOnErrors) {
    const pid_t watch = start("frustumscreen-bake --watch jug --preview jug.html --speech none --size 16");
    ASSERT_TRUE(comes_true([&] { return count("log.txt", "jug.html: new after ") == 1; })) << text("log.txt");
    const std::string first = text("jug.html");
    const std::string file = text("jug/artifact.toml");
    put("jug/artifact.toml", "tilte = \"Jar\"\n" + file);
    ASSERT_TRUE(comes_true([&] { return count("log.txt", "the page stays as it was") == 1; }))
        << text("log.txt");
    EXPECT_EQ(count("log.txt", "jug/artifact.toml:1: tilte"), 1U) << text("log.txt");
    EXPECT_EQ(text("jug.html"), first);
    put(".written_apart", file + "[placement]\nscale = 0.5\n");
    fs::rename(folder / ".written_apart", folder / "jug/artifact.toml");
    ASSERT_TRUE(comes_true([&] { return count("log.txt", "jug.html: new after ") == 2; })) << text("log.txt");
    EXPECT_NE(text("jug.html"), first);
    EXPECT_EQ(check("--reloads"), 0);
    ASSERT_EQ(::kill(watch, SIGINT), 0);
    ASSERT_TRUE(comes_true([&] { return !runs(watch); })) << text("log.txt");
    EXPECT_EQ(check(""), 0) << "nobody draws it again, so it no longer looks for that";
    EXPECT_EQ(count("log.txt", "\n"), 4U) << text("log.txt");
}

TEST_F(BakePreview, ReportsFoldersThatCannotBeWatched) {
    EXPECT_EQ(run("frustumscreen-bake --watch nowhere"), 1);
    EXPECT_EQ(count("err.txt", "nowhere: this is not a folder"), 1U) << text("err.txt");
    fs::remove(folder / "jug/artifact.toml");
    EXPECT_EQ(run("frustumscreen-bake --watch jug"), 1);
    EXPECT_EQ(count("err.txt", "jug: there is no artifact.toml in this folder"), 1U) << text("err.txt");
    EXPECT_EQ(run("frustumscreen-bake --watch jug --preview jug/page.html"), 1);
    EXPECT_NE(text("err.txt").find("jug/page.html: this lies in the watched folder"), std::string::npos)
        << text("err.txt");
    EXPECT_EQ(run("frustumscreen-bake --watch jug --siez 3"), 2);
    EXPECT_EQ(run("frustumscreen-bake --watch"), 2);
    EXPECT_EQ(run("frustumscreen-bake --watch --help"), 0);
}

} // namespace
} // namespace frustumscreen::programs
