#include "firmware_host/base/run_program.h"

#include "firmware_host/base/descriptor.h"
#include "firmware_host/base/printable.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

namespace frustumscreen {

namespace {

using Clock = std::chrono::steady_clock;

/// A file in memory, which a program can read at any speed.
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

/// A running program and its children; the destructor kills them.
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
    /// Its status once it has ended; nullopt while it runs.
    [[nodiscard]] std::optional<int> status() {
        int status = 0;
        if (!status_ && ::waitpid(process_, &status, WNOHANG) == process_) {
            status_ = status;
        }
        return status_;
    }

private:
    pid_t process_;
    std::optional<int> status_;
};

/// Parameters of a start.
struct Start {
    char* const* arguments;
    std::array<int, 3> streams; ///< its standard input, output and error
    std::uint64_t memory_bytes;
};

/// Becomes the program; reports an error number on failure. Uses only calls that are safe after a fork in a
/// threaded process.
[[noreturn]] void become(const Start& how, int report) {
    if (how.memory_bytes > 0) {
        const rlimit limit{how.memory_bytes, how.memory_bytes};
        ::setrlimit(RLIMIT_DATA, &limit);
    }
    int number = 0;
    for (const int stream : how.streams) {
        stream == number ? ::fcntl(number, F_SETFD, 0) : ::dup2(stream, number);
        ++number;
    }
    ::execvp(how.arguments[0], how.arguments);
    const int error = errno;
    [[maybe_unused]] const ssize_t written = ::write(report, &error, sizeof(error));
    ::_exit(127);
}

/// Ends this process with the status of the program.
[[noreturn]] void end_like(int status) {
    if (WIFSIGNALED(status)) {
        const rlimit no_dump{0, 0}; // the program wrote one already, if enabled
        ::setrlimit(RLIMIT_CORE, &no_dump);
        ::signal(WTERMSIG(status), SIG_DFL);
        ::kill(::getpid(), WTERMSIG(status));
    }
    ::_exit(WEXITSTATUS(status));
}

/// A process between ours and the program, in its own group together with everything that the program starts.
/// When our process ends for any reason, the kernel signals the guard, and the guard kills the group.
[[noreturn]] void guard(const Start& how, int report, pid_t us) {
    ::setpgid(0, 0);
    sigset_t none; // our caller may block signals
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    ::signal(SIGTERM, [](int) { ::kill(0, SIGKILL); });
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != us) {
        ::_exit(127); // our process ended before the prctl
    }
    const pid_t program = ::fork();
    if (program == 0) {
        become(how, report);
    }
    if (program < 0) {
        const int error = errno;
        [[maybe_unused]] const ssize_t written = ::write(report, &error, sizeof(error));
        ::_exit(127);
    }
    ::close_range(0, ~0U, 0); // otherwise it would hold our pipes open
    int status = 0;
    while (::waitpid(program, &status, 0) < 0 && errno == EINTR) {
    }
    end_like(status);
}

struct Pipe {
    Descriptor out = Descriptor();
    Descriptor in = Descriptor();
};

/// Both numbers are -1 on failure.
Pipe open_pipe() {
    std::array<int, 2> ends{-1, -1};
    return ::pipe2(ends.data(), O_CLOEXEC) == 0 ? Pipe{Descriptor(ends[0]), Descriptor(ends[1])} : Pipe{};
}

/// Returns the process, or an error number. The program ends with the calling thread.
tl::expected<pid_t, int> start(const std::vector<std::string>& command, const std::array<int, 3>& streams,
                               std::uint64_t memory_bytes) {
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    Pipe report = open_pipe();
    const pid_t us = ::getpid();
    const pid_t process = report.in.number() < 0 ? -1 : ::fork();
    if (process == 0) {
        guard({arguments.data(), streams, memory_bytes}, report.in.number(), us);
    }
    if (process < 0) {
        return tl::unexpected<int>(errno);
    }
    ::setpgid(process, process); // here too, so the group exists before it can be killed
    report.in = Descriptor();
    int error = 0;
    if (::read(report.out.number(), &error, sizeof(error)) == sizeof(error)) {
        ::waitpid(process, nullptr, 0);
        return tl::unexpected<int>(error);
    }
    return process;
}

/// Reads the available bytes; closes `from` at its end.
std::span<const std::byte> read_some(Descriptor& from, std::span<std::byte> block) {
    const ssize_t count = ::read(from.number(), block.data(), block.size());
    if (count <= 0) {
        from = Descriptor();
        return {};
    }
    return block.first(static_cast<std::size_t>(count));
}

/// Follows a program until it has ended and its output is read.
ProgramEnd::How listen(Running& running, Descriptor& output, Descriptor& complaints,
                       const ProgramLimits& limits, ProgramEnd& heard) {
    constexpr int nap_ms = 5;             // the end of a program does not wake the poll
    constexpr std::int64_t look_ms = 100; // neither does `given_up`
    const Clock::time_point deadline = Clock::now() + limits.time;
    std::array<std::byte, 65536> block{};
    for (;;) {
        const std::int64_t left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        if (left <= 0) {
            return ProgramEnd::How::TooLate;
        }
        if (limits.given_up && limits.given_up()) {
            return ProgramEnd::How::GivenUp;
        }
        const bool has_said_all = output.number() < 0;
        const bool has_ended = has_said_all && running.status();
        std::array<pollfd, 2> waited{{{output.number(), POLLIN, 0}, {complaints.number(), POLLIN, 0}}};
        const int wait_ms = static_cast<int>(limits.given_up ? std::min(left, look_ms) : left);
        ::poll(waited.data(), waited.size(), has_ended ? 0 : has_said_all ? nap_ms : wait_ms);
        if (waited[0].revents != 0) {
            const std::span<const std::byte> read = read_some(output, block);
            if (heard.output.size() + read.size() > limits.output_bytes) {
                return ProgramEnd::How::TooMuch;
            }
            heard.output.insert(heard.output.end(), read.begin(), read.end());
        }
        if (waited[1].revents != 0) {
            heard.complaint += as_text(read_some(complaints, block));
            heard.complaint.resize(std::min(heard.complaint.size(), limits.complaint_bytes));
        }
        if (has_ended && (waited[1].revents == 0 || heard.complaint.size() == limits.complaint_bytes)) {
            return ProgramEnd::How::ByItself;
        }
    }
}

std::string name_of(const std::vector<std::string>& command) {
    return command.empty() ? std::string() : printable(command.front());
}

} // namespace

Result<ProgramEnd> follow_program(const std::vector<std::string>& command, std::string_view input,
                                  const ProgramLimits& limits) {
    const Descriptor given = memory_file(input);
    Pipe output = open_pipe();
    Pipe complaints = open_pipe();
    if (command.empty() || given.number() < 0 || output.in.number() < 0 || complaints.in.number() < 0) {
        return fail(ErrorKind::Internal, "program.no_process", "{}: cannot be started: {}", name_of(command),
                    std::strerror(errno));
    }
    const auto process =
        start(command, {given.number(), output.in.number(), complaints.in.number()}, limits.memory_bytes);
    if (!process) {
        return fail(ErrorKind::BadConfiguration, "program.not_started",
                    "{}: cannot be started: {}; install it, or name another program", name_of(command),
                    std::strerror(process.error()));
    }
    output.in = Descriptor(); // otherwise the pipes would never end
    complaints.in = Descriptor();
    Running running(*process);
    ProgramEnd end;
    end.how = listen(running, output.out, complaints.out, limits, end);
    if (end.how == ProgramEnd::How::ByItself) {
        const int status = running.status().value_or(0);
        end.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }
    return end;
}

Result<Bytes> run_program(const std::vector<std::string>& command, std::string_view input,
                          const ProgramLimits& limits) {
    TRY(ProgramEnd end, follow_program(command, input, limits));
    const std::string name = name_of(command);
    if (end.how == ProgramEnd::How::TooMuch) {
        return bad_input("program.too_much_output",
                         "{}: writes more than {} bytes for one text; it was ended", name,
                         limits.output_bytes);
    }
    if (end.how == ProgramEnd::How::TooLate) {
        return bad_input("program.too_slow", "{}: takes longer than {:g} s for one text; it was ended", name,
                         std::chrono::duration<double>(limits.time).count());
    }
    if (end.how == ProgramEnd::How::GivenUp) {
        return bad_input("program.cancelled", "{}: cancelled before it ended", name);
    }
    if (end.status != 0) {
        const std::string why =
            printable(std::string_view(end.complaint).substr(0, end.complaint.find('\n')), 160);
        return bad_input("program.failed", "{}: ends with {} {}{}{}", name,
                         end.status > 0 ? "status" : "signal", std::abs(end.status), why.empty() ? "" : ": ",
                         why);
    }
    return std::move(end.output);
}

} // namespace frustumscreen
