/// Finds a thread of another process by name and stops it for good, as a hanging device does.
#pragma once

#include "tests/base/comes_true.h"

#include <fmt/format.h>
#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace frustumscreen::programs {

/// Waits for the name, because a thread names itself when it first runs.
inline std::optional<pid_t> thread_named(pid_t process, const std::string& wanted) {
    std::optional<pid_t> thread;
    static_cast<void>(comes_true([&] {
        for (const auto& entry : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", process))) {
            std::string name;
            std::getline(std::ifstream(entry.path() / "comm"), name);
            if (name == wanted) {
                thread = std::stoi(entry.path().filename());
            }
        }
        return thread.has_value();
    }));
    return thread;
}

/// Stops a child's thread, which is traced from then on: the test must wait for its end before the child's. False if
/// this machine does not allow tracing.
inline bool hang(pid_t thread) {
    int status = 0;
    return ::ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) == 0 &&
           ::ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) == 0 &&
           ::waitpid(thread, &status, __WALL) == thread;
}

} // namespace frustumscreen::programs
