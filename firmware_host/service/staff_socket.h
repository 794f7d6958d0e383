/// A local stream socket on which the staff ask the exhibit, one question per connection.
///
/// Question `screenshot` and a line feed, at most 64 bytes, within a second.
/// Answer   `ok N`, a line feed and N bytes; or `no SENTENCE` and a line feed. Then the connection is closed.
/// Access   the file has mode 0660; its group is its folder's if the folder passes it on (setgid). In
///          addition, the client must be root, the exhibit's own user, or a member of the file's group, as
///          the kernel reports the process.
/// Limits   one connection at a time, at most twenty per second, each ended after `answer_taken_within`, or after
///          `max_stall` in which the client takes nothing: a client that stalls, floods or sends an invalid
///          question delays only the next client.
/// Threads  its own, of low priority, also for `answer`. It has no heartbeat.
/// Errors   the socket cannot be made. A client's error ends its connection and is not reported elsewhere.
/// Source   unix(7): SO_PEERCRED; SO_PEERGROUPS of Linux 4.13.
#pragma once

#include "firmware_host/base/descriptor.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <string_view>
#include <thread>

namespace frustumscreen::service {

class StaffSocket {
public:
    static constexpr std::size_t max_question_bytes = 64;
    static constexpr Nanoseconds question_within = std::chrono::seconds(1);
    static constexpr Nanoseconds max_stall = std::chrono::seconds(5);
    static constexpr Nanoseconds answer_taken_within = std::chrono::seconds(30);
    static constexpr Nanoseconds between_clients = std::chrono::milliseconds(50);

    /// An error's message becomes the answer's sentence. Must return soon after a stop is requested.
    using Answer = std::function<Result<Bytes>(std::string_view question, const std::stop_token& stop)>;

    [[nodiscard]] static Result<std::unique_ptr<StaffSocket>> open(const std::filesystem::path& path,
                                                                   Answer answer);
    ~StaffSocket();
    StaffSocket(const StaffSocket&) = delete;
    StaffSocket& operator=(const StaffSocket&) = delete;

private:
    StaffSocket(std::filesystem::path path, Descriptor listening, Descriptor stopped, gid_t group,
                Answer answer);
    void work(const std::stop_token& stop);
    void serve(int client, const std::stop_token& stop) const;
    [[nodiscard]] bool wait_for(int descriptor, short events, MonotonicTime until) const;
    [[nodiscard]] Result<std::string> question_of(int client) const;
    void send(int client, std::span<const std::byte> bytes, MonotonicTime until) const;

    std::filesystem::path path_;
    Descriptor listening_;
    Descriptor stopped_; ///< an eventfd, readable once the thread must stop
    gid_t group_;        ///< of the socket's file
    Answer answer_;
    std::jthread thread_; ///< last: it uses all members above
};

/// Asks and waits. Errors: no listener, no permission, the exhibit's own sentence, no answer in time, more
/// than `max_bytes`.
[[nodiscard]] Result<Bytes> ask_staff_socket(const std::filesystem::path& path, std::string_view question,
                                             std::size_t max_bytes, Nanoseconds timeout);

/// The process at the other end, as the kernel reports it.
struct SocketPeer {
    uid_t user = 0;
    gid_t group = 0;
    std::span<const gid_t> more_groups;
};
[[nodiscard]] bool is_staff(const SocketPeer& peer, uid_t own_user, gid_t staff_group);

} // namespace frustumscreen::service
