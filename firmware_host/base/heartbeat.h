/// A device thread's promise to be heard of again: renewed before each call that may take long, read by
/// whoever watches. A promise that is broken means that the thread hangs, not that its device does: the
/// promise is longer than the kernel lets any one call take.
///
/// Threads  one promises, any reads; neither waits.
#pragma once

#include "firmware_host/base/time.h"

#include <atomic>

namespace frustumscreen {

class Heartbeat {
public:
    explicit Heartbeat(MonotonicTime until) : until_(until.time_since_epoch().count()) {}
    void promise(MonotonicTime until) { until_ = until.time_since_epoch().count(); }
    [[nodiscard]] MonotonicTime promised_until() const { return MonotonicTime(Nanoseconds(until_.load())); }

private:
    std::atomic<Nanoseconds::rep> until_;
};

} // namespace frustumscreen
