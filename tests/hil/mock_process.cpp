#include "tests/hil/mock_process.h"

#include "tests/folders.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <optional>

extern char** environ;

namespace frustumscreen::tests {

namespace {

constexpr int answer_timeout_ms = 30'000;

class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { reset(); }
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    [[nodiscard]] int get() const { return number_; }
    void reset() {
        if (number_ >= 0) {
            ::close(std::exchange(number_, -1));
        }
    }

private:
    int number_;
};

std::optional<Descriptor> connect_to(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof(address.sun_path)) {
        return std::nullopt;
    }
    std::memcpy(address.sun_path, path.data(), path.size());
    Descriptor connection(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (::connect(connection.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
        return std::nullopt;
    }
    return connection;
}

/// Length of a HID tracker's report by its number (docs/hid_tracker.md), because a stream has no report boundaries.
std::size_t report_bytes(std::byte number) {
    return number == std::byte{1} ? 34 : 10;
}

class SocketTransport final : public tracker::UsbTransport {
public:
    SocketTransport(Descriptor connection, bool reports)
        : connection_(std::move(connection)), reports_(reports) {}

    [[nodiscard]] Result<std::size_t> read(std::span<std::byte> buffer, Nanoseconds timeout) override {
        pollfd waiting{connection_.get(), POLLIN, 0};
        const auto ms = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
        if (::poll(&waiting, 1, static_cast<int>(ms)) == 0) {
            return 0U;
        }
        if (reports_ && ::recv(connection_.get(), buffer.data(), 1, MSG_PEEK) == 1) {
            buffer = buffer.first(report_bytes(buffer.front()));
        }
        const ssize_t count =
            ::recv(connection_.get(), buffer.data(), buffer.size(), reports_ ? MSG_WAITALL : 0);
        if (count <= 0) {
            return fail(ErrorKind::DeviceLost, "test.device", "the mock has closed the socket");
        }
        return static_cast<std::size_t>(count);
    }
    [[nodiscard]] Result<void> write(std::span<const std::byte> bytes, Nanoseconds /*timeout*/) override {
        const ssize_t count = ::send(connection_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (count != static_cast<ssize_t>(bytes.size())) {
            return fail(ErrorKind::DeviceLost, "test.device", "the mock has closed the socket");
        }
        return {};
    }
    void close() override { connection_.reset(); }

private:
    Descriptor connection_;
    bool reports_; ///< each read returns one whole report
};

class SocketBus final : public tracker::UsbBus {
public:
    SocketBus(std::string path, tracker::UsbTrackerModel model) : path_(std::move(path)), model_(model) {}

    [[nodiscard]] tl::expected<tracker::FoundTracker, tracker::UsbTrackerState>
    find(std::span<const std::string> /*but_not*/) override {
        std::optional<Descriptor> connection = connect_to(path_);
        if (!connection) {
            return tl::unexpected(tracker::UsbTrackerState::NotConnected);
        }
        return tracker::FoundTracker{std::make_unique<SocketTransport>(
                                         std::move(*connection), model_ == tracker::UsbTrackerModel::Hid),
                                     model_, path_};
    }

private:
    std::string path_;
    tracker::UsbTrackerModel model_;
};

} // namespace

MockProcess::MockProcess(std::vector<std::string> arguments, std::string control)
    : control_(std::move(control)) {
    arguments.insert(arguments.begin(), source_dir() + "/tests/hil/mock_tracker");
    arguments.insert(arguments.end(), {"--control", control_});
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) {
        pointers.push_back(argument.data());
    }
    pointers.push_back(nullptr);
    EXPECT_EQ(::posix_spawn(&process_, pointers.front(), nullptr, nullptr, pointers.data(), environ), 0);
    for (int tries = 0; tries < 3000 && !connect_to(control_); ++tries) {
        ::usleep(10'000);
    }
}

MockProcess::~MockProcess() {
    if (process_ > 0) {
        ::kill(process_, SIGTERM);
        int status = 0;
        ::waitpid(process_, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "the mock ended with " << status;
    }
}

std::string MockProcess::tell(const std::string& command) const {
    const std::optional<Descriptor> connection = connect_to(control_);
    if (!connection) {
        return {};
    }
    const std::string line = command + "\n";
    if (::send(connection->get(), line.data(), line.size(), MSG_NOSIGNAL) !=
        static_cast<ssize_t>(line.size())) {
        return {};
    }
    std::string answer;
    std::array<char, 4096> buffer{};
    while (answer.empty() || answer.back() != '\n') {
        pollfd waiting{connection->get(), POLLIN, 0};
        const bool ready = ::poll(&waiting, 1, answer_timeout_ms) > 0;
        const ssize_t count = ready ? ::recv(connection->get(), buffer.data(), buffer.size(), 0) : 0;
        if (count <= 0) {
            return {};
        }
        answer.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return answer;
}

std::unique_ptr<tracker::UsbBus> make_socket_bus(std::string path, tracker::UsbTrackerModel model) {
    return std::make_unique<SocketBus>(std::move(path), model);
}

} // namespace frustumscreen::tests
