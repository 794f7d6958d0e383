#include "firmware_host/base/printable.h"
#include "firmware_host/service/staff_socket.h"
#include "firmware_host/service/unix_address.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>

namespace frustumscreen::service {

namespace {

constexpr std::size_t max_head_bytes = 400;

/// Reads until the exhibit closes the connection; nullopt: a timeout, or too many bytes.
std::optional<Bytes> read_all(int socket, std::size_t max_bytes, MonotonicTime until) {
    Bytes bytes;
    std::array<std::byte, 65536> part{};
    while (bytes.size() <= max_bytes) {
        const std::int64_t left_ms =
            std::chrono::ceil<std::chrono::milliseconds>(until - monotonic_now()).count();
        pollfd ready{socket, POLLIN, 0};
        if (left_ms <= 0 || ::poll(&ready, 1, static_cast<int>(left_ms)) <= 0) {
            return std::nullopt;
        }
        const ssize_t got = ::recv(socket, part.data(), part.size(), 0);
        if (got <= 0) {
            return bytes;
        }
        bytes.insert(bytes.end(), part.begin(), part.begin() + got);
    }
    return std::nullopt;
}

/// `answer` is the complete answer. Errors: one sentence.
Result<Bytes> content_of(Bytes answer) {
    const std::string_view text = as_text(answer);
    const std::size_t end = text.substr(0, max_head_bytes).find('\n');
    const std::string_view head = text.substr(0, end == std::string_view::npos ? 0 : end);
    if (head.starts_with("no ")) {
        return bad_input("staff.exhibit_says", "the exhibit says: " + printable(head.substr(3), 300));
    }
    std::size_t size = 0;
    const char* const head_end = head.data() + head.size();
    if (!head.starts_with("ok ")) {
        return bad_input("staff.no_exhibit", "the program that listens there is not an exhibit");
    }
    const std::from_chars_result read = std::from_chars(head.data() + 3, head_end, size);
    if (read.ec != std::errc{} || read.ptr != head_end || answer.size() - end - 1 != size) {
        return bad_input("staff.cut_off", "its answer was cut off; ask again");
    }
    answer.erase(answer.begin(), answer.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    return answer;
}

std::string_view why_unreachable() {
    switch (errno) {
    case ENOENT:
    case ECONNREFUSED:
        return "no exhibit listens there; does it run, with --staff-socket?";
    case EACCES:
        return "only root and the staff's group may ask";
    case EAGAIN:
        return "too many ask at once; ask again";
    default:
        return std::strerror(errno);
    }
}

} // namespace

Result<Bytes> ask_staff_socket(const std::filesystem::path& path, std::string_view question,
                               std::size_t max_bytes, Nanoseconds timeout) {
    const std::string place = printable(path.string(), 200);
    const std::optional<UnixAddress> address = UnixAddress::of(path);
    if (!address) {
        return bad_input("staff.socket_path", place + ": a socket's path has 1 to 107 bytes");
    }
    const Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    // Limits the wait at a socket whose queue is full.
    const timeval longest{std::chrono::ceil<std::chrono::seconds>(timeout).count(), 0};
    static_cast<void>(::setsockopt(socket.number(), SOL_SOCKET, SO_SNDTIMEO, &longest, sizeof(longest)));
    if (::connect(socket.number(), address->get(), address->size()) != 0) {
        return bad_input("staff.unreachable", "{}: {}", place, why_unreachable());
    }
    const std::string line = std::string(question) + "\n";
    // If the exhibit has closed the connection already, its answer gives the reason.
    static_cast<void>(::send(socket.number(), line.data(), line.size(), MSG_NOSIGNAL));
    std::optional<Bytes> answer =
        read_all(socket.number(), max_bytes + max_head_bytes, monotonic_now() + timeout);
    if (!answer) {
        return bad_input("staff.no_answer",
                         place + ": the exhibit does not answer in time; it hangs, or others ask it too");
    }
    return at(place, content_of(std::move(*answer)));
}

} // namespace frustumscreen::service
