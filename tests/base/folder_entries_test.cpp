// The entries of a folder, in order; a folder that cannot be read is an error and no exception.

#include "firmware_host/base/folder_entries.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace frustumscreen {
namespace {

using FolderEntriesTest = WithTemporaryFolder;

TEST_F(FolderEntriesTest, ListsEntriesSortedByName) {
    for (const char* const name : {"c", "a", "d/inner", "b"}) {
        put(name, "");
    }
    const FolderEntries listed = entries_of(folder);
    EXPECT_FALSE(listed.failed);
    std::vector<std::string> names;
    for (const std::filesystem::directory_entry& entry : listed) {
        names.push_back(entry.path().filename().string());
    }
    EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c", "d"}));
}

TEST_F(FolderEntriesTest, FailsWithoutAFolder) {
    put("file", "");
    for (const std::filesystem::path& no_folder : {folder / "file", folder / "missing"}) {
        const FolderEntries listed = entries_of(no_folder);
        EXPECT_TRUE(listed.failed) << no_folder;
        EXPECT_TRUE(listed.entries.empty());
    }
}

} // namespace
} // namespace frustumscreen
