// What a killed run leaves beside its output, and what the next run may clear away.

#include "firmware_host/base/file.h"
#include "firmware_host/base/output_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

namespace frustumscreen {
namespace {

namespace fs = std::filesystem;

class PartialFiles : public ::testing::Test {
protected:
    void SetUp() override {
        std::string name = fs::temp_directory_path() / "frustumscreen_XXXXXX";
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder = name;
    }
    void TearDown() override { fs::remove_all(folder); }
    void put(const std::string& name) const {
        ASSERT_TRUE(write_file(folder / name, as_bytes("half of a pack")));
    }
    /// The number of a process that has ended and was waited for.
    static std::string gone() {
        const pid_t child = ::fork();
        if (child == 0) {
            ::_exit(0);
        }
        ::waitpid(child, nullptr, 0);
        return std::to_string(child);
    }

    fs::path folder;
};

TEST_F(PartialFiles, OfAProcessThatIsGoneAreClearedAway) {
    const std::string left = "scan.fspack.part" + gone();
    put(left);
    ASSERT_TRUE(check_output_place(folder / "scan.fspack"));
    EXPECT_FALSE(fs::exists(folder / left));
}

TEST_F(PartialFiles, OfALivingProcessAndOfOtherNamesStay) {
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

} // namespace
} // namespace frustumscreen
