/// A device thread's promise of when it will be heard from again. The thread renews it before each call that
/// may take long. While a promise is broken the service manager's watchdog is not fed, which has patience for ten
/// seconds more: together they are longer than the kernel lets any one call take, so what ends the exhibit is a thread
/// that hangs, not a device.
///
/// Threads  one thread promises, any thread reads; neither waits.
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
