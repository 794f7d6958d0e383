#include "app/bench/plots/draw_tables.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

extern char** environ;

namespace frustumscreen::bench {

namespace {

std::string read_all(int descriptor) {
    std::string text;
    std::array<char, 4096> part{};
    for (;;) {
        const ssize_t count = ::read(descriptor, part.data(), part.size());
        if (count > 0) {
            text.append(part.data(), static_cast<std::size_t>(count));
        } else if (count == 0 || errno != EINTR) {
            return text;
        }
    }
}

/// If a script ends with an exception, Python names it in the last line.
std::string last_line(std::string text) {
    text.erase(text.find_last_not_of(" \n") + 1);
    return text.substr(text.rfind('\n') + 1); // the whole text if it has no line break
}

} // namespace

std::filesystem::path plot_script() {
    std::error_code failed;
    return std::filesystem::read_symlink("/proc/self/exe", failed).parent_path() / "plots" / "draw_plots.py";
}

Result<void> draw_tables(const std::filesystem::path& script, const std::vector<std::string>& arguments) {
    const std::string program = script.string();
    std::vector<std::string> words = {program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
        return fail(ErrorKind::Internal, "plots.no_process", "no plots: {}", std::strerror(errno));
    }
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    pid_t child = 0;
    const int failed = ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    const std::string said = read_all(ends[0]);
    ::close(ends[0]);
    if (failed != 0) {
        return fail(ErrorKind::Internal, "plots.no_program",
                    "no plots: {} does not run ({}); it needs Debian's package python3-matplotlib", program,
                    std::strerror(failed));
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (status != 0) {
        return fail(ErrorKind::Internal, "plots.failed",
                    said.empty() ? fmt::format("no plots: {} failed", program) : last_line(said));
    }
    return {};
}

} // namespace frustumscreen::bench
