// The machine's state from kernel files, against files of the test's own; a disk's space, against std::filesystem.
#include "app/watch/machine.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace frustumscreen::watch {
namespace {

namespace fs = std::filesystem;

class MachineOfFiles : public testing::Test {
protected:
    MachineOfFiles() {
        std::string pattern = (fs::temp_directory_path() / "machine.XXXXXX").string();
        root_ = ::mkdtemp(pattern.data());
    }
    ~MachineOfFiles() override { fs::remove_all(root_); }

    void write(const fs::path& file, const std::string& text) const {
        fs::create_directories((root_ / file).parent_path());
        std::ofstream(root_ / file) << text;
    }

    fs::path root_;
};

TEST_F(MachineOfFiles, IsAsHotAsItsHottestProcessorOrZone) {
    EXPECT_FALSE(hottest_c(root_));
    write("sys/class/thermal/thermal_zone0/temp", "-274000\n"); // a missing sensor
    write("sys/class/thermal/cooling_device0/temp", "99000\n");
    write("sys/class/hwmon/hwmon0/name", "nvme\n");
    write("sys/class/hwmon/hwmon0/temp1_input", "84000\n");
    EXPECT_FALSE(hottest_c(root_)) << "a disk may be hotter than the processor, and is none";
    write("sys/class/thermal/thermal_zone1/temp", "-5500\n");
    EXPECT_EQ(hottest_c(root_), -5.5);
    write("sys/class/thermal/thermal_zone2/temp", "no number\n");
    EXPECT_EQ(hottest_c(root_), -5.5);
    write("sys/class/hwmon/hwmon1/name", "coretemp\n");
    write("sys/class/hwmon/hwmon1/temp1_crit", "100000\n");
    write("sys/class/hwmon/hwmon1/temp1_input", "48000\n");
    write("sys/class/hwmon/hwmon1/temp2_input", "51250\n");
    EXPECT_EQ(hottest_c(root_), 51.25);
    write("sys/class/thermal/thermal_zone1/temp", "63000\n");
    EXPECT_EQ(hottest_c(root_), 63.0);
}

TEST_F(MachineOfFiles, HasADisk) {
    const std::optional<DiskSpace> disk = disk_space(root_);
    ASSERT_TRUE(disk);
    const fs::space_info other = fs::space(root_);
    EXPECT_EQ(disk->size_bytes, other.capacity);
    EXPECT_NEAR(static_cast<double>(disk->free_bytes), static_cast<double>(other.available),
                0.05 * static_cast<double>(other.capacity)) // other programs write meanwhile
        << disk->free_bytes;
    EXPECT_TRUE(disk->writable);
    EXPECT_GT(disk->free_share(), 0.0);
    EXPECT_FALSE(disk_space(root_ / "nowhere"));
}

} // namespace
} // namespace frustumscreen::watch
