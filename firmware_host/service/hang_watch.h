/// Reports a thread that has given no sign of life for too long, from a thread of its own, because a hanging
/// thread cannot report itself.
///
/// Time     a parameter of the policy; the watch reads the monotonic clock.
/// Threads  `enters`: the watched thread; it never waits. `tell` is called on the watch's own thread.
/// Errors   none.
#pragma once

#include "firmware_host/base/time.h"

#include <atomic>
#include <functional>
#include <optional>
#include <stop_token>
#include <thread>

namespace frustumscreen::service {

/// Decides whether silence is a hang. If the watch itself did not run, because the machine or the process was
/// suspended, it restarts its count, because the silence may not be the thread's fault.
class HangPolicy {
public:
    explicit HangPolicy(Nanoseconds timeout) : timeout_(timeout) {}
    [[nodiscard]] Nanoseconds between_looks() const { return timeout_ / 16; }

    enum class News { None, Hangs, HeardAgain };
    /// `heard`: time of the thread's last sign of life.
    [[nodiscard]] News look(MonotonicTime now, MonotonicTime heard);

private:
    Nanoseconds timeout_;
    std::optional<MonotonicTime> looked_;
    MonotonicTime watched_since_;
    std::optional<MonotonicTime> hung_; ///< last sign of life before the reported hang
};

class HangWatch {
public:
    /// `doing`: the thread's last entered activity, when it hangs; nullopt = it has recovered.
    using Tell = std::function<void(std::optional<const char*> doing)>;
    HangWatch(Nanoseconds timeout, Tell tell);

    /// A sign of life: the thread begins `doing` now. The string must be static.
    void enters(const char* doing);

private:
    void run(const std::stop_token& stop);

    HangPolicy policy_;
    Tell tell_;
    std::atomic<Nanoseconds::rep> heard_;
    std::atomic<const char*> doing_{""};
    std::jthread thread_; ///< last: it uses all members above
};

} // namespace frustumscreen::service
