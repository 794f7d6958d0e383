// Files that a killed run leaves next to its output, and which of them the next run may delete.

#include "firmware_host/base/file.h"
#include "firmware_host/base/output_file.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

namespace frustumscreen {
namespace {

namespace fs = std::filesystem;

class PartialFiles : public WithTemporaryFolder {
protected:
    void put(const std::string& name) const { WithTemporaryFolder::put(name, "half of a pack"); }
    /// The id of a process that has ended and was waited for.
    static std::string gone() {
        const pid_t child = ::fork();
        if (child == 0) {
            ::_exit(0);
        }
        ::waitpid(child, nullptr, 0);
        return std::to_string(child);
    }
};

TEST_F(PartialFiles, DeletesFilesOfAnEndedProcess) {
    const std::string left = "scan.fspack.part" + gone();
    put(left);
    ASSERT_TRUE(check_output_place(folder / "scan.fspack"));
    EXPECT_FALSE(fs::exists(folder / left));
}

TEST_F(PartialFiles, KeepsFilesOfLivingProcessesAndOtherNames) {
    const std::string number = gone();
    const std::string names[] = {"scan.fspack",
                                 "scan.fspack.part" + std::to_string(::getppid()),
                                 "scan.fspack.part1",
                                 "scan.fspack.part",
                                 "scan.fspack.part0",
                                 "scan.fspack.part-" + number,
                                 "scan.fspack.part" + number + "a",
                                 "scan.fspack.part99999999999999999999",
                                 "other.fspack.part" + number,
                                 "scan.fspack.participants"};
    for (const std::string& name : names) {
        put(name);
    }
    fs::create_directory(folder / ("scan.fspack.part" + number));
    ASSERT_TRUE(check_output_place(folder / "scan.fspack"));
    for (const std::string& name : names) {
        EXPECT_TRUE(fs::exists(folder / name)) << name;
    }
    EXPECT_TRUE(fs::exists(folder / ("scan.fspack.part" + number)));
}

/// No file can be created next to it, as on a full disk.
TEST_F(PartialFiles, OverwritesInPlaceIfNoPartFileCanBeCreated) {
    const fs::path status = folder / "status.json";
    ASSERT_TRUE(renew_file(status, as_bytes("a long one")));
    fs::create_directory(status.string() + ".part" + std::to_string(::getpid()));
    EXPECT_FALSE(write_file(status, as_bytes("never")));
    for (const std::string_view text : {"short", "longer than both before it", ""}) {
        ASSERT_TRUE(renew_file(status, as_bytes(text)));
        const Result<Bytes> read = read_file(status);
        ASSERT_TRUE(read);
        EXPECT_EQ(as_text(*read), text);
    }
}

TEST_F(PartialFiles, FailsForANewFileIfNoPartFileCanBeCreated) {
    const fs::path status = folder / "status.json";
    fs::create_directory(status.string() + ".part" + std::to_string(::getpid()));
    const Result<void> renewed = renew_file(status, as_bytes("first"));
    ASSERT_FALSE(renewed);
    EXPECT_EQ(renewed.error().id, "file.not_written") << renewed.error().message;
    EXPECT_FALSE(fs::exists(status));
}

} // namespace
} // namespace frustumscreen
