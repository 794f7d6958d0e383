// Files of a curator's folder that nothing uses: which are named, and which are ignored.
#include "assets_baked/folder/unused_files.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

using namespace frustumscreen;
using namespace frustumscreen::folder;
namespace fs = std::filesystem;

namespace {

class UnusedFiles : public WithTemporaryFolder {};

TEST_F(UnusedFiles, ListsOnlyFilesThatAreNotUsed) {
    for (const char* name :
         {"artifact.toml", "vase.obj", "Vase.mtl", "skin.png", "old.png", "talk.wav", "notes.txt"}) {
        put(name, "x");
    }
    fs::create_directory(folder / "sub");
    put("sub/other.png", "x");
    const std::vector<fs::path> used{folder / "vase.obj", folder / "sub/../Vase.mtl", folder / "./skin.png",
                                     folder / "missing.png", fs::path()};
    EXPECT_EQ(unused_files(folder, used), (std::vector<std::string>{"notes.txt", "old.png", "talk.wav"}));
    EXPECT_TRUE(unused_files(folder / "nowhere", used).empty());
}

TEST_F(UnusedFiles, IgnoresHiddenFilesAndOutputOfABake) {
    for (const char* name :
         {"artifact.toml", ".DS_Store", "._vase.obj", "Thumbs.db", "desktop.ini", "vase.fspack",
          "vase.fspack.minisig", "vase.preview.html", "vase.fspack.part123"}) {
        put(name, "x");
    }
    EXPECT_TRUE(unused_files(folder, {}).empty());
}

TEST(UnusedFilesSentence, NamesTheFirstFew) {
    EXPECT_EQ(sentence_on_unused({}), "");
    EXPECT_EQ(sentence_on_unused({"a.png"}),
              "that a.png beside artifact.toml is not used: neither it nor the scan names it");
    EXPECT_EQ(sentence_on_unused({"1", "2", "3", "4", "5", "6", "7"}),
              "that 1, 2, 3, 4, 5 and 2 more beside artifact.toml are not used: neither it nor the scan "
              "names them");
}

} // namespace
