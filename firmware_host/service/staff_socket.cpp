#include "firmware_host/service/staff_socket.h"

#include "firmware_host/base/device_thread.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/service/unix_address.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::service {

namespace {

constexpr int max_waiting = 4;

tl::unexpected<Error> cannot_listen(const std::filesystem::path& path, std::string_view reason) {
    return fail(ErrorKind::BadConfiguration, "staff.no_socket", "{}: the staff's socket cannot be made: {}",
                path.string(), reason);
}

/// Whether `path` is free. Removes the socket of an exhibit that was killed.
bool is_free(const UnixAddress& address, const std::filesystem::path& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) {
        return errno == ENOENT;
    }
    const Descriptor probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (!S_ISSOCK(status.st_mode) || ::connect(probe.number(), address.get(), address.size()) == 0 ||
        errno != ECONNREFUSED) {
        return false;
    }
    return ::unlink(path.c_str()) == 0;
}

std::vector<gid_t> more_groups_of(int client) {
    std::vector<gid_t> groups(64);
    for (int attempt = 0; attempt < 2; ++attempt) {
        auto bytes = static_cast<socklen_t>(groups.size() * sizeof(gid_t));
        const bool read = ::getsockopt(client, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &bytes) == 0;
        if (!read && errno != ERANGE) {
            return {};
        }
        groups.resize(bytes / sizeof(gid_t));
        if (read) {
            return groups;
        }
    }
    return {};
}

bool may_ask(int client, gid_t staff_group) {
    ucred credentials{};
    socklen_t bytes = sizeof(credentials);
    if (::getsockopt(client, SOL_SOCKET, SO_PEERCRED, &credentials, &bytes) != 0) {
        return false;
    }
    const std::vector<gid_t> groups = more_groups_of(client);
    return is_staff({credentials.uid, credentials.gid, groups}, ::geteuid(), staff_group);
}

} // namespace

bool is_staff(const SocketPeer& peer, uid_t own_user, gid_t staff_group) {
    return peer.user == 0 || peer.user == own_user || peer.group == staff_group ||
           std::find(peer.more_groups.begin(), peer.more_groups.end(), staff_group) != peer.more_groups.end();
}

Result<std::unique_ptr<StaffSocket>> StaffSocket::open(const std::filesystem::path& path, Answer answer) {
    const std::optional<UnixAddress> address = UnixAddress::of(path);
    if (!address) {
        return cannot_listen(path, "a socket's path has at most 107 bytes");
    }
    if (!is_free(*address, path)) {
        return cannot_listen(path, "something else is there, or another exhibit listens there");
    }
    Descriptor listening(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    struct stat file {};
    // No client can connect before listen(), and by then the mode is right.
    if (::bind(listening.number(), address->get(), address->size()) != 0 ||
        ::chmod(path.c_str(), 0660) != 0 || ::stat(path.c_str(), &file) != 0 ||
        ::listen(listening.number(), max_waiting) != 0) {
        return cannot_listen(path, std::strerror(errno));
    }
    Descriptor stopped(::eventfd(0, EFD_CLOEXEC));
    if (stopped.number() < 0) {
        return cannot_listen(path, std::strerror(errno));
    }
    return std::unique_ptr<StaffSocket>(
        new StaffSocket(path, std::move(listening), std::move(stopped), file.st_gid, std::move(answer)));
}

StaffSocket::StaffSocket(std::filesystem::path path, Descriptor listening, Descriptor stopped, gid_t group,
                         Answer answer)
    : path_(std::move(path)), listening_(std::move(listening)), stopped_(std::move(stopped)), group_(group),
      answer_(std::move(answer)), thread_([this](const std::stop_token& stop) { work(stop); }) {}

StaffSocket::~StaffSocket() {
    thread_.request_stop();
    static_cast<void>(::eventfd_write(stopped_.number(), 1));
    static_cast<void>(::unlink(path_.c_str()));
}

void StaffSocket::work(const std::stop_token& stop) {
    begin_device_thread("staff socket", ThreadPriority::Low);
    while (!stop.stop_requested()) {
        if (wait_for(listening_.number(), POLLIN, MonotonicTime::max())) {
            const Descriptor client(
                ::accept4(listening_.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
            if (client.number() >= 0) {
                serve(client.number(), stop);
            }
        }
        // A pause, whatever the client did.
        static_cast<void>(wait_for(-1, 0, monotonic_now() + between_clients));
    }
}

/// Returns false on a timeout, or if the thread must stop. A negative `descriptor` only waits.
bool StaffSocket::wait_for(int descriptor, short events, MonotonicTime until) const {
    std::array<pollfd, 2> both{{{stopped_.number(), POLLIN, 0}, {descriptor, events, 0}}};
    const auto left_ms = [until] {
        return until == MonotonicTime::max()
                   ? -1
                   : static_cast<int>(std::max<std::int64_t>(
                         std::chrono::ceil<std::chrono::milliseconds>(until - monotonic_now()).count(), 0));
    };
    int ready = 0;
    do {
        ready = ::poll(both.data(), both.size(), left_ms());
    } while (ready < 0 && errno == EINTR);
    return ready > 0 && both[0].revents == 0 && both[1].revents != 0;
}

void StaffSocket::serve(int client, const std::stop_token& stop) const {
    Result<Bytes> answer =
        bad_input("staff.not_allowed", "only the staff may ask this: be root, or in the socket's group");
    if (may_ask(client, group_)) {
        const Result<std::string> question = question_of(client);
        answer = question ? answer_(*question, stop) : tl::unexpected<Error>(question.error());
    }
    const std::string head = answer ? fmt::format("ok {}\n", answer->size())
                                    : fmt::format("no {}\n", printable(answer.error().message, 300));
    const MonotonicTime until = monotonic_now() + answer_taken_within;
    send(client, as_bytes(head), until);
    if (answer) {
        send(client, *answer, until);
    }
}

Result<std::string> StaffSocket::question_of(int client) const {
    const MonotonicTime until = monotonic_now() + question_within;
    std::string question;
    while (question.size() < max_question_bytes) {
        std::array<char, max_question_bytes> text{};
        if (!wait_for(client, POLLIN, until)) {
            return bad_input("staff.no_question_came", "no question came within a second");
        }
        const ssize_t got = ::recv(client, text.data(), max_question_bytes - question.size(), 0);
        if (got <= 0) {
            return bad_input("staff.question_without_end", "the question has no end");
        }
        question.append(text.data(), static_cast<std::size_t>(got));
        if (const std::size_t end = question.find('\n'); end != std::string::npos) {
            question.resize(end);
            return question;
        }
    }
    return bad_input("staff.question_too_long", "a question has at most {} bytes", max_question_bytes);
}

void StaffSocket::send(int client, std::span<const std::byte> bytes, MonotonicTime until) const {
    for (MonotonicTime now = monotonic_now(); !bytes.empty() && now < until; now = monotonic_now()) {
        if (!wait_for(client, POLLOUT, std::min(until, now + max_stall))) {
            return;
        }
        const ssize_t sent = ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) {
            return;
        }
        bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
}

} // namespace frustumscreen::service
