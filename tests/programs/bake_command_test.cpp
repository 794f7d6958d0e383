// What `frustumscreen-bake` writes, and what it never replaces.

#include "app/image/image.h"
#include "app/pack/pack_file.h"
#include "tests/programs/program_folder.h"

#include <algorithm>
#include <array>

namespace frustumscreen {
namespace {

namespace fs = std::filesystem;

class BakeCommand : public ProgramFolder {
protected:
    void SetUp() override {
        ProgramFolder::SetUp();
        put("scan.obj", "mtllib scan.mtl\n"
                        "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 1 0\n"
                        "vt 0 0\nvt 1 0\nvt 0 1\n"
                        "usemtl skin\n"
                        "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 1/1 4/2 3/3\nf 2/1 3/2 4/3\n");
        put("scan.mtl", "newmtl skin\nKd 1 1 1\nmap_Kd skin.png\nnorm normals.png\n");
        const Bytes picture = encode_png(Image8(4, 4, {200, 120, 60, 255}));
        ASSERT_TRUE(write_file(folder / "skin.png", picture));
        ASSERT_TRUE(write_file(folder / "normals.png", picture));
        put("notes.txt", "what the curator wrote down");
    }
    void put(const std::string& file, const std::string& content) const {
        ASSERT_TRUE(write_file(folder / file, as_bytes(content)));
    }
    [[nodiscard]] int bake_to(const std::string& output, const std::string& more = "") const {
        return run(fmt::format("frustumscreen-bake scan.obj --size 32 -o '{}' {}", output, more));
    }
    /// It ends with one line that holds `reason`, and every file of the folder is as it was.
    void refused(const std::string& output, const std::string& reason, const std::string& more = "") const {
        constexpr std::array files = {"scan.obj", "scan.mtl", "skin.png", "normals.png", "notes.txt"};
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
        EXPECT_TRUE(load_pack(folder / "scan.fspack"));
    }
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
    for (const char* output : {"scan.mtl", "skin.png", "normals.png"}) {
        refused(output, "is not a pack");
        refused(output, fmt::format("would replace the input {}", output), "--force");
    }
}

TEST_F(BakeCommand, ReplacesAnotherFileOnlyByForce) {
    refused("notes.txt", "notes.txt: this file is there and is not a pack");
    ASSERT_EQ(bake_to("notes.txt", "--force"), 0) << text("err.txt");
    EXPECT_TRUE(load_pack(folder / "notes.txt"));
}

TEST_F(BakeCommand, LooksAtTheOutputBeforeTheWork) {
    put("scan.obj", "no model at all"); // what is wrong with the output is said first
    fs::create_directory(folder / "folder");
    refused("nowhere/scan.fspack", "there is no folder nowhere; make it first");
    refused("folder", "not a regular file");
    refused("/proc/scan.fspack", "/proc: nothing can be written into this folder");
}

TEST_F(BakeCommand, TakesEachLanguageAndCaptionOnce) {
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"--caption 'en=A cat.' --caption 'en=A dog.'",
         "--caption 'en=A dog.': there is a caption in en already; write one for each language"},
        {"--language en --language de --language en", "--language 'en': it is named already"},
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
        bake_to("scan.fspack", "--title Cat --language en --language de --caption 'de=Eine Katze=Kater.'"), 0)
        << text("err.txt");
    const auto pack = load_pack(folder / "scan.fspack");
    ASSERT_TRUE(pack);
    ASSERT_EQ((*pack)->captions.size(), 2U);
    EXPECT_EQ((*pack)->captions[0].text, "");
    EXPECT_EQ((*pack)->captions[1].title, "Cat");
    EXPECT_EQ((*pack)->captions[1].text, "Eine Katze=Kater.");
}

/// A file system of one megabyte, where the test may make one.
TEST_F(BakeCommand, LooksForRoomBeforeTheWork) {
    fs::create_directory(folder / "small");
    const std::string program = fmt::format("'{}'/frustumscreen-bake", FRUSTUMSCREEN_BIN_DIR);
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
} // namespace frustumscreen
