/// The machine's state from the kernel: its temperature, and the free space of its disk.
///
/// Threads  any. Reads small files of the kernel, and a disk's free space, which the kernel keeps in memory as
///          well.
/// Errors   none: a value that the kernel does not give is nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace frustumscreen::watch {

/// The highest value of the thermal zones and the processor's own sensors below `root`/sys, degrees Celsius.
[[nodiscard]] std::optional<double> hottest_c(const std::filesystem::path& root);

struct DiskSpace {
    std::uint64_t free_bytes = 0; ///< for a program that is not root
    std::uint64_t size_bytes = 0;
    bool writable = true;
    [[nodiscard]] double free_share() const {
        return static_cast<double>(free_bytes) / static_cast<double>(size_bytes);
    }
};
/// The space of the file system that holds `folder`.
[[nodiscard]] std::optional<DiskSpace> disk_space(const std::filesystem::path& folder);

} // namespace frustumscreen::watch
