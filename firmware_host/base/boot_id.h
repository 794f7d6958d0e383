/// The kernel's name for the time since this machine was started.
///
/// Threads  any.
/// Errors   empty where the kernel does not say.
/// Source   boot_id in random(4).
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace frustumscreen {

/// `root`: a folder that stands for /, for tests.
[[nodiscard]] inline std::string boot_id(const std::filesystem::path& root = "/") {
    std::string id;
    std::getline(std::ifstream(root / "proc/sys/kernel/random/boot_id"), id);
    return id;
}

} // namespace frustumscreen
