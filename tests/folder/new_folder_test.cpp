// A new folder for a curator: its contents, and the files that it never replaces.
#include "assets_baked/folder/artifact_file.h"
#include "assets_baked/folder/new_folder.h"
#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <string>

using namespace frustumscreen;
using namespace frustumscreen::folder;
namespace fs = std::filesystem;

namespace {

class NewFolder : public WithTemporaryFolder {
protected:
    void SetUp() override {
        put("in/scan.obj", "mtllib scan.mtl");
        put("in/scan.mtl", "a material");
        put("in/pictures/skin.png", "a picture");
        scan = {folder / "in/scan.obj",
                {folder / "in/scan.mtl", folder / "in/pictures/skin.png", folder / "in/missing.png"},
                {-1, 0, 2},
                {1, 5, 4},
                'y',
                {},
                {},
                {},
                {}};
    }
    ScanFacts scan;
};

/// Uncomments the example lines, as a curator would.
std::string with_every_hint(std::string text) {
    for (std::size_t at = 0; (at = text.find("\n#", at)) != std::string::npos; ++at) {
        if (text.compare(at, 3, "\n# ") != 0 && text.compare(at, 3, "\n#\n") != 0) {
            text.erase(at + 1, 1);
        }
    }
    return text;
}

} // namespace

TEST_F(NewFolder, contains_the_scan_its_files_and_a_valid_artifact_file) {
    const Result<fs::path> file = start_folder(folder / "out/vase", scan);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(*file, folder / "out/vase/artifact.toml");
    EXPECT_EQ(text("out/vase/scan.obj"), "mtllib scan.mtl");
    EXPECT_EQ(text("out/vase/scan.mtl"), "a material");
    EXPECT_EQ(text("out/vase/pictures/skin.png"), "a picture");
    const Result<ArtifactFile> read = read_artifact_file(folder / "out/vase");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->scan, folder / "out/vase/scan.obj");
    EXPECT_EQ(read->id.substr(0, 5), "scan-");
    ASSERT_EQ(read->texts.size(), 1U);
    EXPECT_EQ(read->texts[0].title, "scan");
    EXPECT_TRUE(read->hotspots.empty());
    EXPECT_NE(text("out/vase/artifact.toml").find("reaches from [-1, 0, 2] to [1, 5, 4]"), std::string::npos);
}

TEST_F(NewFolder, has_only_valid_hints) {
    const std::string text = with_every_hint(new_artifact_text(scan, "A \"small\" vase", "vase-1"));
    const Result<ArtifactFile> read = parse_artifact_file(text, "artifact.toml");
    ASSERT_TRUE(read) << read.error().message << "\n" << text;
    EXPECT_EQ(read->texture, "skin.png");
    EXPECT_EQ(read->texts[0].title, "A \"small\" vase");
    EXPECT_EQ(read->texts[0].description, "First sentence.\nSecond sentence.");
    ASSERT_EQ(read->texts.size(), 2U);
    ASSERT_EQ(read->hotspots.size(), 1U);
    EXPECT_EQ(read->hotspots[0].point_file, glm::dvec3(0, 2.5, 3));
    EXPECT_EQ(read->up, "y");
    EXPECT_EQ(read->turn_deg, 0.0);
    EXPECT_EQ(read->size, 512) << "hints have the values that hold without them";
    EXPECT_EQ(read->scale, 1.0);
    EXPECT_EQ(read->prop, "frustum");
}

TEST_F(NewFolder, copies_the_metadata_of_the_scan) {
    scan.title = "Egyptian \"Cat\"";
    scan.author = "Ann (https://example.org/ann)";
    scan.licence = "CC-BY-4.0";
    scan.source = "https://example.org/cat";
    ASSERT_TRUE(start_folder(folder / "out", scan));
    const Result<ArtifactFile> read = read_artifact_file(folder / "out");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->texts[0].title, scan.title);
    EXPECT_EQ(read->author, scan.author);
    EXPECT_EQ(read->licence, scan.licence);
    EXPECT_EQ(read->source, scan.source);
    EXPECT_EQ(read->id.substr(0, 9), "egyptian-");
    scan.author = scan.licence = scan.source = "";
    const Result<ArtifactFile> silent =
        parse_artifact_file(new_artifact_text(scan, "Cat", "cat"), "artifact.toml");
    EXPECT_EQ(silent->licence + silent->author + silent->source, "") << "examples are no statements";
}

TEST_F(NewFolder, leaves_no_truncated_file_after_a_failed_write) {
    put("in/pictures/skin.png", std::string(100'000, 'x'));
    struct rlimit before {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const struct rlimit small { 50'000, before.rlim_max };
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Result<fs::path> started = start_folder(folder / "out", scan);
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    ASSERT_FALSE(started);
    EXPECT_EQ(started.error().id, "folder.not_copied") << started.error().message;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder / "out")) {
        EXPECT_TRUE(entry.is_directory()) << entry.path();
    }
    EXPECT_TRUE(start_folder(folder / "out", scan)) << "the next try finds nothing in its way";
}

TEST_F(NewFolder, replaces_no_files) {
    ASSERT_TRUE(start_folder(folder / "in", scan)) << "a scan that lies there stays";
    const std::string before = text("in/artifact.toml");
    const Result<fs::path> again = start_folder(folder / "in", scan);
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().id, "folder.artifact_file_there") << again.error().message;
    EXPECT_EQ(text("in/artifact.toml"), before);
    put("other/pictures/skin.png", "another picture");
    const Result<fs::path> other = start_folder(folder / "other", scan);
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().id, "folder.there_already") << other.error().message;
    EXPECT_EQ(text("other/pictures/skin.png"), "another picture");
    EXPECT_FALSE(fs::exists(folder / "other/scan.obj"));
}

TEST_F(NewFolder, rejects_side_files_outside_the_folder_of_the_scan) {
    put("skin.png", "a picture");
    scan.side_files.push_back(folder / "in/../skin.png");
    const Result<fs::path> file = start_folder(folder / "out", scan);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().id, "folder.side_file_outside") << file.error().message;
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(NewFolder, gives_each_artifact_a_unique_id) {
    ASSERT_TRUE(start_folder(folder / "a", scan));
    ASSERT_TRUE(start_folder(folder / "b", scan));
    EXPECT_NE(read_artifact_file(folder / "a")->id, read_artifact_file(folder / "b")->id);
}
