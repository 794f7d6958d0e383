/// A device thread's promise of when it will give its next sign of life. The thread renews the promise before
/// each call that may take long. While a promise is broken, the exhibit does not feed the service manager's
/// watchdog, which waits another ten seconds. Both times together exceed the kernel's limit for any one call,
/// so only a hanging thread ends the exhibit, not a slow device.
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
