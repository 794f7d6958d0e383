/// What the kernel says of the machine: how hot it is, how much room its disk has.
///
/// Threads  any. Reads small files of the kernel, and the free space of a disk, which the kernel keeps in memory, too.
/// Errors   none: what it does not say is nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace frustumscreen {

/// Of the thermal zones and the processor's own sensors below `root`/sys, degrees Celsius.
[[nodiscard]] std::optional<double> hottest_c(const std::filesystem::path& root);

struct DiskSpace {
    std::uint64_t free_bytes = 0; ///< for a program that is not root
    std::uint64_t size_bytes = 0;
    bool writable = true;
    [[nodiscard]] double free_share() const {
        return static_cast<double>(free_bytes) / static_cast<double>(size_bytes);
    }
};
/// Of the file system that `folder` is on.
[[nodiscard]] std::optional<DiskSpace> disk_space(const std::filesystem::path& folder);

} // namespace frustumscreen
