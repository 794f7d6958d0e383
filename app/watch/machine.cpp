#include "app/watch/machine.h"

#include "firmware_host/base/folder_entries.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>

namespace frustumscreen::watch {

namespace {

namespace fs = std::filesystem;

constexpr double coldest_c = -100.0; ///< lower values are no temperatures
/// Kernel drivers of the sensors in processors (Documentation/hwmon); on many machines the thermal zones do not
/// include these.
constexpr std::array<std::string_view, 4> processor_sensors{"coretemp", "k10temp", "k8temp", "cpu_thermal"};

template <typename Visit>
void for_each_in(const fs::path& folder, std::string_view begin, const Visit& visit) {
    for (const fs::directory_entry& entry : entries_of(folder)) {
        if (entry.path().filename().string().starts_with(begin)) {
            visit(entry.path());
        }
    }
}

/// Keeps the higher temperature; a file has thousandths of a degree.
void take_hotter(const fs::path& file, std::optional<double>& hottest) {
    double thousandths = 0.0;
    std::ifstream stream(file);
    if (stream >> thousandths && 1e-3 * thousandths > coldest_c) {
        hottest = std::max(hottest.value_or(coldest_c), 1e-3 * thousandths);
    }
}

} // namespace

std::optional<double> hottest_c(const fs::path& root) {
    std::optional<double> hottest;
    for_each_in(root / "sys/class/thermal", "thermal_zone",
                [&](const fs::path& zone) { take_hotter(zone / "temp", hottest); });
    for_each_in(root / "sys/class/hwmon", "hwmon", [&](const fs::path& chip) {
        std::string name;
        std::ifstream(chip / "name") >> name;
        if (std::find(processor_sensors.begin(), processor_sensors.end(), name) == processor_sensors.end()) {
            return;
        }
        for_each_in(chip, "temp", [&](const fs::path& file) {
            if (file.filename().string().ends_with("_input")) {
                take_hotter(file, hottest);
            }
        });
    });
    return hottest;
}

std::optional<DiskSpace> disk_space(const fs::path& folder) {
    struct statvfs disk {};
    if (::statvfs(folder.c_str(), &disk) != 0 || disk.f_blocks == 0) {
        return std::nullopt;
    }
    const std::uint64_t unit = disk.f_frsize;
    return DiskSpace{unit * disk.f_bavail, unit * disk.f_blocks, (disk.f_flag & ST_RDONLY) == 0};
}

} // namespace frustumscreen::watch
