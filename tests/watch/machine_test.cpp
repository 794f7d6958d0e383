// The machine's state from kernel files, against files of the test's own; a disk's space, against std::filesystem.
#include "app/watch/machine.h"
#include "tests/base/temporary_folder.h"

#include <gtest/gtest.h>

namespace frustumscreen::watch {
namespace {

namespace fs = std::filesystem;

class MachineOfFiles : public WithTemporaryFolder {};

TEST_F(MachineOfFiles, ReportsTheHottestProcessorOrZone) {
    EXPECT_FALSE(hottest_c(folder));
    put("sys/class/thermal/thermal_zone0/temp", "-274000\n"); // a missing sensor
    put("sys/class/thermal/cooling_device0/temp", "99000\n");
    put("sys/class/hwmon/hwmon0/name", "nvme\n");
    put("sys/class/hwmon/hwmon0/temp1_input", "84000\n");
    EXPECT_FALSE(hottest_c(folder)) << "a disk may be hotter than the processor, and is none";
    put("sys/class/thermal/thermal_zone1/temp", "-5500\n");
    EXPECT_EQ(hottest_c(folder), -5.5);
    put("sys/class/thermal/thermal_zone2/temp", "no number\n");
    EXPECT_EQ(hottest_c(folder), -5.5);
    put("sys/class/hwmon/hwmon1/name", "coretemp\n");
    put("sys/class/hwmon/hwmon1/temp1_crit", "100000\n");
    put("sys/class/hwmon/hwmon1/temp1_input", "48000\n");
    put("sys/class/hwmon/hwmon1/temp2_input", "51250\n");
    EXPECT_EQ(hottest_c(folder), 51.25);
    put("sys/class/thermal/thermal_zone1/temp", "63000\n");
    EXPECT_EQ(hottest_c(folder), 63.0);
}

TEST_F(MachineOfFiles, ReportsDiskSpace) {
    const std::optional<DiskSpace> disk = disk_space(folder);
    ASSERT_TRUE(disk);
    const fs::space_info other = fs::space(folder);
    EXPECT_EQ(disk->size_bytes, other.capacity);
    EXPECT_NEAR(static_cast<double>(disk->free_bytes), static_cast<double>(other.available),
                0.05 * static_cast<double>(other.capacity)) // other programs write meanwhile
        << disk->free_bytes;
    EXPECT_TRUE(disk->writable);
    EXPECT_GT(disk->free_share(), 0.0);
    EXPECT_FALSE(disk_space(folder / "nowhere"));
}

} // namespace
} // namespace frustumscreen::watch
