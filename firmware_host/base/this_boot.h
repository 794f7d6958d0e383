/// The current boot of this machine: the kernel's id of it, and the time since.
///
/// Threads  any.
/// Errors   the id is empty if the kernel does not provide it.
/// Source   boot_id in random(4), CLOCK_BOOTTIME in clock_gettime(2).
#pragma once

#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>

namespace frustumscreen {

/// `root`: a folder in place of /, for tests.
[[nodiscard]] inline std::string boot_id(const std::filesystem::path& root = "/") {
    std::string id;
    std::getline(std::ifstream(root / "proc/sys/kernel/random/boot_id"), id);
    return id;
}

/// Includes time that the machine slept.
[[nodiscard]] inline std::chrono::milliseconds since_boot() {
    std::timespec time{};
    ::clock_gettime(CLOCK_BOOTTIME, &time);
    return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::seconds(time.tv_sec) +
                                                                 std::chrono::nanoseconds(time.tv_nsec));
}

} // namespace frustumscreen
