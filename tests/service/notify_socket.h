// A service manager's end of NOTIFY_SOCKET, for tests.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>

namespace frustumscreen::service {

class NotifySocket {
public:
    NotifySocket()
        : path_(std::filesystem::temp_directory_path() /
                ("frustumscreen_notify_" + std::to_string(::getpid()))),
          socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        ::unlink(path_.c_str());
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
        bound_ = ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    }
    ~NotifySocket() {
        ::close(socket_);
        ::unlink(path_.c_str());
    }
    NotifySocket(const NotifySocket&) = delete;
    NotifySocket& operator=(const NotifySocket&) = delete;

    [[nodiscard]] bool bound() const { return bound_; }
    [[nodiscard]] std::string path() const { return path_.string(); }
    /// The next message; waits for it at most `wait_ms`; nullopt: none came.
    [[nodiscard]] std::optional<std::string> receive(int wait_ms = 0) const {
        const timeval limit{wait_ms / 1000, (wait_ms % 1000) * 1000};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
        std::array<char, 4096> text{};
        const ssize_t size = ::recv(socket_, text.data(), text.size(), wait_ms == 0 ? MSG_DONTWAIT : 0);
        return size < 0 ? std::nullopt
                        : std::optional(std::string(text.data(), static_cast<std::size_t>(size)));
    }

private:
    std::filesystem::path path_;
    int socket_;
    bool bound_ = false;
};

} // namespace frustumscreen::service
