/// Reports a thread that was not heard from for too long. It has its own thread: one that hangs cannot
/// report.
///
/// Time     a parameter of the policy; the watch reads the monotonic clock.
/// Threads  `enters`: the thread that is watched; it waits for nothing. `tell` is called on the watch's own.
/// Errors   none.
#pragma once

#include "firmware_host/base/time.h"

#include <atomic>
#include <functional>
#include <optional>
#include <stop_token>
#include <thread>

namespace frustumscreen {

/// Decides when silence is a hang. A watch that did not run itself, because the machine or the process stood
/// still, has not seen the silence and starts counting again.
class HangPolicy {
public:
    explicit HangPolicy(Nanoseconds patience) : patience_(patience) {}
    [[nodiscard]] Nanoseconds between_looks() const { return patience_ / 16; }

    enum class News { None, Hangs, HeardAgain };
    /// `heard`: when the thread was last heard of.
    [[nodiscard]] News look(MonotonicTime now, MonotonicTime heard);

private:
    Nanoseconds patience_;
    std::optional<MonotonicTime> looked_;
    MonotonicTime watched_since_;
    std::optional<MonotonicTime> hung_; ///< when the thread was last heard from before the reported hang
};

class HangWatch {
public:
    /// `doing`: what the thread entered last, while it hangs; nothing = it is heard again.
    using Tell = std::function<void(std::optional<const char*> doing)>;
    HangWatch(Nanoseconds patience, Tell tell);

    /// The thread lives, and does this from now on; `doing` must live for ever.
    void enters(const char* doing);

private:
    void run(const std::stop_token& stop);

    HangPolicy policy_;
    Tell tell_;
    std::atomic<Nanoseconds::rep> heard_;
    std::atomic<const char*> doing_{""};
    std::jthread thread_; ///< last: it uses all of the above
};

} // namespace frustumscreen
