// When a watched folder counts as changed, with the kernel's own inotify; when a burst of changes is over, by a simulated clock.
#include "app/programs/watch/folder_watch.h"
#include "app/programs/watch/settle_time.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace frustumscreen::watch {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

class WatchedFolder : public WithTemporaryFolder {
protected:
    void SetUp() override {
        fs::create_directories(folder / "recordings" / "en");
        put("artifact.toml");
    }
    void put(const std::string& file) const { std::ofstream(folder / file) << "x"; }
};

TEST_F(WatchedFolder, DetectsWrittenRenamedAndRemovedFiles) {
    Result<programs::FolderWatch> watch = programs::FolderWatch::open(folder);
    ASSERT_TRUE(watch) << watch.error().message;
    EXPECT_FALSE(*watch->take()) << "nothing has happened yet";
    put("artifact.toml");
    EXPECT_TRUE(*watch->take());
    EXPECT_FALSE(*watch->take()) << "it was taken";
    put(".artifact.toml.swx");
    EXPECT_FALSE(*watch->take()) << "an editor's file";
    fs::rename(folder / ".artifact.toml.swx", folder / "artifact.toml");
    EXPECT_TRUE(*watch->take()) << "editors that write by rename";
    put("recordings/en/description.wav");
    EXPECT_TRUE(*watch->take()) << "two folders down";
    fs::remove(folder / "recordings" / "en" / "description.wav");
    EXPECT_TRUE(*watch->take());
}

TEST_F(WatchedFolder, IgnoresAFileUntilItIsClosed) {
    Result<programs::FolderWatch> watch = programs::FolderWatch::open(folder);
    ASSERT_TRUE(watch);
    std::ofstream scan(folder / "scan.glb");
    scan << "half of it" << std::flush;
    EXPECT_FALSE(*watch->take());
    scan.close();
    EXPECT_TRUE(*watch->take());
}

TEST_F(WatchedFolder, WatchesAFolderThatIsCreatedLater) {
    Result<programs::FolderWatch> watch = programs::FolderWatch::open(folder);
    ASSERT_TRUE(watch);
    fs::create_directories(folder / "recordings" / "de");
    EXPECT_TRUE(*watch->take());
    put("recordings/de/description.wav");
    EXPECT_TRUE(*watch->take());
}

TEST_F(WatchedFolder, WatchesFoldersBehindSymbolicLinks) {
    const fs::path elsewhere = folder.string() + "_scans";
    fs::create_directories(elsewhere / "deep");
    fs::create_directory_symlink(elsewhere, folder / "scans");
    fs::create_directory_symlink(folder, folder / "recordings" / "back"); // and round and round
    fs::create_directory_symlink(folder / "recordings", elsewhere / "deep" / "again");
    fs::create_symlink("itself", folder / "itself");
    Result<programs::FolderWatch> watch = programs::FolderWatch::open(folder);
    ASSERT_TRUE(watch) << watch.error().message;
    std::ofstream(elsewhere / "deep" / "scan.glb") << "x";
    EXPECT_TRUE(*watch->take());
    put("artifact.toml");
    EXPECT_TRUE(*watch->take());
    EXPECT_FALSE(*watch->take()) << "once";
    fs::create_directories(elsewhere / "later");
    EXPECT_TRUE(*watch->take());
    fs::create_directory_symlink(elsewhere / "later", folder / "linked");
    fs::create_symlink("nowhere", folder / "nowhere");
    EXPECT_TRUE(*watch->take());
    std::ofstream(elsewhere / "later" / "scan.glb") << "x";
    EXPECT_TRUE(*watch->take());
    fs::remove_all(elsewhere);
    EXPECT_TRUE(*watch->take());
    fs::remove_all(folder / "scans");
    EXPECT_TRUE(*watch->take()) << "and the folder itself is still there";
}

TEST_F(WatchedFolder, ReportsThatTheFolderIsGone) {
    Result<programs::FolderWatch> watch = programs::FolderWatch::open(folder);
    ASSERT_TRUE(watch);
    const fs::path elsewhere = folder.string() + "_moved";
    fs::rename(folder, elsewhere);
    const Result<bool> taken = watch->take();
    fs::remove_all(elsewhere);
    ASSERT_FALSE(taken);
    EXPECT_NE(taken.error().message.find(folder.string() + ": this folder is gone"), std::string::npos)
        << taken.error().message;
    EXPECT_FALSE(programs::FolderWatch::open(folder)) << "and now there is none";
}

TEST(PassingNames, MatchTemporaryFilesOfEditorsAndCopies) {
    for (const char* name :
         {".artifact.toml.swp", "artifact.toml~", "#artifact.toml#", "4913", "x.html.part123", "a.tmp"}) {
        EXPECT_TRUE(programs::is_passing_name(name)) << name;
    }
    for (const char* name : {"artifact.toml", "scan.glb", "x.party", "49131", "spare.part.glb"}) {
        EXPECT_FALSE(programs::is_passing_name(name)) << name;
    }
}

TEST(SettleTime, ExpiresAfterAPeriodWithoutChanges) {
    const MonotonicTime start = from_microseconds(5'000'000);
    programs::SettleTime settle(300ms);
    EXPECT_FALSE(settle.take(start));
    EXPECT_FALSE(settle.left(start));
    settle.changed(start);
    EXPECT_EQ(settle.left(start + 100ms), Nanoseconds(200ms));
    EXPECT_FALSE(settle.take(start + 299ms));
    settle.changed(start + 299ms); // once more
    EXPECT_FALSE(settle.take(start + 598ms));
    EXPECT_TRUE(settle.take(start + 599ms));
    EXPECT_FALSE(settle.take(start + 600ms)) << "once for each burst";
}

} // namespace
} // namespace frustumscreen::watch
