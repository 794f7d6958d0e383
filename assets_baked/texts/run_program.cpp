#include "assets_baked/texts/run_program.h"

#include "firmware_host/base/printable.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <thread>
#include <utility>

extern char** environ;

namespace frustumscreen {

namespace {

using Clock = std::chrono::steady_clock;

class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor() {
        if (number_ >= 0) {
            ::close(number_);
        }
    }
    [[nodiscard]] int number() const { return number_; }

private:
    int number_;
};

/// A file in memory, which a program can read or write however slowly.
Descriptor memory_file(std::string_view text) {
    Descriptor file(::memfd_create("text", MFD_CLOEXEC));
    std::size_t written = 0;
    while (file.number() >= 0 && written < text.size()) {
        const ssize_t count = ::write(file.number(), text.data() + written, text.size() - written);
        if (count <= 0) {
            return Descriptor();
        }
        written += static_cast<std::size_t>(count);
    }
    ::lseek(file.number(), 0, SEEK_SET);
    return file;
}

std::string first_line_of(const Descriptor& file) {
    std::array<char, 200> text{};
    const ssize_t count = ::pread(file.number(), text.data(), text.size(), 0);
    const std::string_view read(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
    return printable(read.substr(0, read.find('\n')), 160);
}

/// A program and what it started, which end with this.
class Running {
public:
    explicit Running(pid_t process) : process_(process) {}
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    ~Running() {
        ::kill(-process_, SIGKILL);
        if (!status_) {
            int status = 0;
            ::waitpid(process_, &status, 0);
        }
    }
    /// Its status once it has ended; nothing while it runs on to the deadline.
    [[nodiscard]] std::optional<int> wait(Clock::time_point deadline) {
        constexpr std::chrono::milliseconds nap(5);
        int status = 0;
        while (::waitpid(process_, &status, WNOHANG) != process_) {
            if (Clock::now() > deadline) {
                return std::nullopt;
            }
            std::this_thread::sleep_for(nap);
        }
        status_ = status;
        return status_;
    }

private:
    pid_t process_;
    std::optional<int> status_;
};

/// The process; or an error number.
tl::expected<pid_t, int> start(const std::vector<std::string>& command, const Descriptor& input,
                               const Descriptor& output, const Descriptor& complaints) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, input.number(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, output.number(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, complaints.number(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP); // so that it ends with what it starts
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    pid_t process = 0;
    const int error = ::posix_spawnp(&process, arguments[0], &files, &attributes, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) {
        return tl::unexpected<int>(error);
    }
    return process;
}

enum class Ended { Whole, TooLate, TooMuch };

Ended read_all(const Descriptor& from, const ProgramLimits& limits, Clock::time_point deadline,
               Bytes& output) {
    std::array<std::byte, 65536> block{};
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd waited{from.number(), POLLIN, 0};
        if (left <= 0 || ::poll(&waited, 1, static_cast<int>(left)) == 0) {
            return Ended::TooLate;
        }
        const ssize_t count = ::read(from.number(), block.data(), block.size());
        if (count <= 0) {
            return Ended::Whole;
        }
        if (output.size() + static_cast<std::size_t>(count) > limits.output_bytes) {
            return Ended::TooMuch;
        }
        output.insert(output.end(), block.begin(), block.begin() + count);
    }
}

} // namespace

Result<Bytes> run_program(const std::vector<std::string>& command, std::string_view input,
                          const ProgramLimits& limits) {
    const std::string name = command.empty() ? std::string() : printable(command.front());
    std::array<int, 2> pipe{-1, -1};
    const Descriptor given = memory_file(input);
    const Descriptor complaints = memory_file({});
    if (command.empty() || given.number() < 0 || complaints.number() < 0 ||
        ::pipe2(pipe.data(), O_CLOEXEC) != 0) {
        return fail(ErrorKind::Internal,
                    fmt::format("{}: cannot be started: {}", name, std::strerror(errno)));
    }
    const Descriptor out(pipe[0]);
    Descriptor in(pipe[1]);
    const auto process = start(command, given, in, complaints);
    if (!process) {
        return fail(ErrorKind::BadConfiguration,
                    fmt::format("{}: cannot be started: {}; install it, or name another program", name,
                                std::strerror(process.error())));
    }
    in = Descriptor(); // else the pipe would never end
    Running running(*process);
    const Clock::time_point deadline = Clock::now() + limits.time;
    Bytes output;
    const Ended ended = read_all(out, limits, deadline, output);
    const std::optional<int> status = ended == Ended::Whole ? running.wait(deadline) : std::nullopt;
    if (ended == Ended::TooMuch) {
        return bad_input(fmt::format("{}: writes more than {} bytes for one text; it was ended", name,
                                     limits.output_bytes));
    }
    if (!status) {
        return bad_input(fmt::format("{}: takes longer than {:g} s for one text; it was ended", name,
                                     std::chrono::duration<double>(limits.time).count()));
    }
    if (!WIFEXITED(*status) || WEXITSTATUS(*status) != 0) {
        const std::string why = first_line_of(complaints);
        return bad_input(fmt::format(
            "{}: ends with {} {}{}{}", name, WIFEXITED(*status) ? "status" : "signal",
            WIFEXITED(*status) ? WEXITSTATUS(*status) : WTERMSIG(*status), why.empty() ? "" : ": ", why));
    }
    return output;
}

} // namespace frustumscreen
